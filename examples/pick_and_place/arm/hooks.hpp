// What the components do beside what their machines decide: pictures, places, motion.
//
// Which move comes next, when it is done, and what the jaw is to do is in Planner.asm, Robot.asm and Gripper.asm. Here is where
// the moves lead, and how the arm gets there. A robot without a move stands; a motor without a fresh set-point brakes.
#pragma once

#include <functional>
#include <vector>

#include <groundstate/kinematics/camera_motion.hpp>
#include <groundstate/kinematics/follower.hpp>
#include <groundstate/servo/visual_servo.hpp>
#include <groundstate/vision/disc_detector.hpp>

#include "generated/placing_system_machines.hpp"
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
    Place last_{};
};

/// A move, and when it was sent.
struct Sent {
    std::int64_t at_ns = 0;
    Move move{};
    Target target{};
};

/// The machine says which move is next; here is where it leads.
class PlacePlanner final : public PlannerMachine {
  public:
    /// Where the parts are to go, in this order.
    PlacePlanner(Now now, std::vector<Place> row) : now_{std::move(now)}, row_{std::move(row)} { sent_.reserve(1000); }
    bool plan(const Cycle& cycle, const In& in, Out& out) override;

    std::size_t placed() const noexcept { return static_cast<std::size_t>(machine().placed()); }
    /// Grips after which nothing was in the jaw.
    long missed() const noexcept { return missed_; }
    /// The first thousand moves.
    const std::vector<Sent>& sent() const noexcept { return sent_; }

  private:
    Now now_;
    std::vector<Place> row_;
    std::vector<Sent> sent_{};
    long missed_ = 0;
    Place part_{};
    Target target_{};
};

/// The machine says what is to be done; the tool goes straight to where the move leads.
class ToolMover final : public RobotMachine {
  public:
    ToolMover(Now now, const groundstate::kinematics::ArmModel& arm)
        : now_{std::move(now)}, motion_{arm, {.most_acceleration = 3}} {}
    bool control(const Cycle& cycle, const In& in, Out& out) override;
    /// Whether the last cycle left the tool where its move leads.
    bool arrived(const Cycle&) override { return arrived_; }

  private:
    bool go(const Joints& measured, const Target& target, double dt);

    Now now_;
    groundstate::kinematics::CameraMotion motion_;
    bool arrived_ = false;
    std::int64_t last_ns_ = -1;
};

/// Between the machine and the jaw: its sensor and its valve.
class JawController final : public GripperMachine {
  public:
    using Ask = std::function<Feel(bool closed)>;
    explicit JawController(Ask ask) : ask_{std::move(ask)} {}
    Feel jaw(const Cycle&) override { return ask_(closed_); }
    void valve(const Cycle&, bool closed) override { closed_ = closed; }

  private:
    Ask ask_;
    bool closed_ = false;
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
