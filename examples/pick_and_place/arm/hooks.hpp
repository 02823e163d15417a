// What the components do: finding parts, planning, moving, gripping.
//
// The planner sends one move at a time, and the next when the robot has reported it done: above the part, down, close, up,
// above its place, down, open, up. If nothing is in the jaw after `up`, the part is looked for again. A robot without a
// move stands; a motor without a fresh set-point brakes.
#pragma once

#include <functional>
#include <vector>

#include <groundstate/kinematics/camera_motion.hpp>
#include <groundstate/kinematics/follower.hpp>
#include <groundstate/servo/visual_servo.hpp>
#include <groundstate/vision/disc_detector.hpp>

#include "generated/placing_system.hpp"
#include "table.hpp"

namespace placing_system {

using Now = std::function<std::int64_t()>;

class TableCamera final : public Camera {
  public:
    TableCamera(Now now, Table& table) : now_{std::move(now)}, table_{table} {}
    bool grab(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    Table& table_;
};

class PartFinder final : public Vision {
  public:
    bool find(const Cycle& cycle, const In& in, Out& out) override;

  private:
    groundstate::vision::DiscDetector detector_{640, 480, {.dark = false, .least_area = 40}};
};

/// A move, and when it was sent.
struct Sent {
    std::int64_t at_ns = 0;
    Moves move{};
};

class PlacePlanner final : public Planner {
  public:
    /// Where the parts are to go, in this order.
    PlacePlanner(Now now, std::vector<Place> row) : now_{std::move(now)}, row_{std::move(row)} { sent_.reserve(1000); }
    bool plan(const Cycle& cycle, const In& in, Out& out) override;

    std::size_t placed() const noexcept { return placed_; }
    long missed() const noexcept { return missed_; }
    /// The first thousand moves.
    const std::vector<Sent>& sent() const noexcept { return sent_; }

  private:
    enum class Step { look, over, down, close, up, carry, lower, open, rise, aside };

    bool choose(const Parts& parts);
    Moves move() const;
    void next(const Progress& progress);

    Now now_;
    std::vector<Place> row_;
    std::vector<Sent> sent_{};
    std::size_t placed_ = 0;
    long missed_ = 0;
    Step step_ = Step::look;
    Place part_{};
    std::int64_t number_ = 0;
    bool waits_ = false;  ///< for a move to be done
    std::int64_t free_ns_ = 0;  ///< images from then on show the table without the arm's last part
};

class ToolMover final : public Robot {
  public:
    ToolMover(Now now, const groundstate::kinematics::ArmModel& arm)
        : now_{std::move(now)}, motion_{arm, {.most_acceleration = 3}} {}
    bool control(const Cycle& cycle, const In& in, Out& out) override;

  private:
    bool go(const Joints& measured, double dt);

    Now now_;
    groundstate::kinematics::CameraMotion motion_;
    Moves move_{};
    std::int64_t done_ = 0;
    bool closed_ = false;
    std::int64_t last_ns_ = -1;
};

class JawController final : public Gripper {
  public:
    using Jaw = std::function<Grip(bool closed)>;
    explicit JawController(Jaw jaw) : jaw_{std::move(jaw)} {}
    bool close(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Jaw jaw_;
};

class JointDrives final : public Motor {
  public:
    using Command = std::function<void(std::int64_t now_ns, const Joints& velocity)>;
    JointDrives(Now now, Command command) : now_{std::move(now)}, command_{std::move(command)} {}
    bool drive(const Cycle& cycle, const In& in, Out& out) override;
    /// The joints stand: nobody leads them any more.
    void safe_stop() noexcept override;

  private:
    Now now_;
    Command command_;
    groundstate::kinematics::Follower<6> follower_{};
};

class JointEncoders final : public Encoder {
  public:
    using Read = std::function<Joints(std::int64_t now_ns)>;
    JointEncoders(Now now, Read read) : now_{std::move(now)}, read_{std::move(read)} {}
    bool acquire(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    Read read_;
};

}  // namespace placing_system
