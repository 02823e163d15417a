// What the components of the controller do: one class each, implementing the hooks of ControllerSystem.chart.
//
// Whether the discs are searched, tracked or lost, whether set-points are given, and whether the arm follows them or comes to rest is in
// Servoing.asm and Arm.asm. Here pictures become features, and these become velocities and positions.
//
// Each keeps what it did in a recording of its own, in memory reserved before; nobody reads it before the run has ended.
// No hook throws, allocates (but the whole-image search) or waits.
#pragma once

#include <climits>
#include <functional>
#include <memory>
#include <vector>

#include <groundstate/frame_source.hpp>
#include <groundstate/kinematics/camera_motion.hpp>
#include <groundstate/kinematics/follower.hpp>
#include <groundstate/vision/disc_tracker.hpp>

#include "cell.hpp"
#include "generated/controller_system_machines.hpp"

namespace controller_system {

/// The instant, by the clock of the run.
using Now = std::function<std::int64_t()>;

/// When a target is sent, and from where the camera is to see it: a pose in the frame of the target.
struct Goal {
    std::int64_t at_ns = 0;
    Eigen::Isometry3d camera = Eigen::Isometry3d::Identity();
};

/// Sends the targets when their time has come.
class GoalSender final : public Operator {
  public:
    GoalSender(Now now, const Cell& cell, std::vector<Goal> goals);
    bool plan(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    std::vector<Goal> goals_;
    std::vector<Targets> targets_{};
    std::size_t next_ = 0;
    std::int64_t origin_ns_ = -1;
};

/// Fetches images from any source.
class ImageGrabber final : public Camera {
  public:
    using Grab = std::function<groundstate::Grab(groundstate::FrameView, groundstate::Watchdog&)>;
    explicit ImageGrabber(Grab grab) : grab_{std::move(grab)} {}
    bool grab(const Cycle& cycle, const In& in, Out& out) override;

    std::int64_t without_image() const noexcept { return without_image_; }

  private:
    Grab grab_;
    std::int64_t without_image_ = 0;
};

struct ServoingSettings {
    groundstate::servo::Intrinsics lens{};
    groundstate::servo::ServoSettings law{.gain = {3.0, 0.9, 12.0}};
    /// How many images are made up for, the machine says.
    groundstate::vision::TrackerSettings tracker{.discs = {.dark = false}, .most_predicted = INT_MAX};
    double close = 5e-3;  ///< error of the features, in the image plane at distance 1: near enough to the target
    /// Images kept for looking at afterwards: so long after a target came, for so many targets.
    std::vector<std::int64_t> keep_after_ns{100'000'000, 600'000'000, 2'000'000'000};
    std::size_t targets_kept = 2;
};

/// What one image gave.
struct Sight {
    std::int64_t at_ns = 0;
    std::int64_t captured_ns = 0;
    std::int64_t target = 0;  ///< its number; 0: none yet
    ServoMode mode = ServoMode::WITHOUT_TARGET;
    groundstate::vision::Tracked tracked{};
    groundstate::servo::Command command{};
};

/// An image that was kept.
struct Kept {
    std::int64_t captured_ns = 0;
    std::int64_t target = 0;  ///< 0: nothing was kept
    groundstate::vision::Tracked tracked{};
    std::unique_ptr<groundstate::Frame<640, 480>> frame = std::make_unique<groundstate::Frame<640, 480>>();
};

/// The machine says what is searched and followed, and whether a set-point is given; here is what is seen, and the set-point.
class ServoingByImages : public VisualServoingMachine {
  public:
    ServoingByImages(Now now, const ServoingSettings& settings, std::size_t sights);
    void before_sensors(const Cycle& cycle, const In& in) override;
    bool has_target(const Cycle&) override { return target_ != 0; }
    bool is_seen(const Cycle&) override { return sight_.tracked.track == groundstate::vision::Track::tracking; }
    bool has_law(const Cycle&) override { return sight_.tracked && sight_.command; }
    bool is_close(const Cycle&) override { return sight_.tracked && sight_.command.error < settings_.close; }
    bool set_point(const Cycle& cycle, const In& in, Out& out) override;
    void panel(const Cycle&, ServoMode) override {}
    void guiding(const Cycle&, bool) override {}

    const std::vector<Sight>& sights() const noexcept { return sights_; }
    const std::vector<Kept>& kept() const noexcept { return kept_; }
    const groundstate::servo::View& desired() const noexcept { return desired_; }
    long searches() const noexcept { return tracker_.searches(); }

  private:
    void aim(const Targets& target);
    void keep(const CameraToVs& image);

    Now now_;
    ServoingSettings settings_;
    groundstate::vision::DiscTracker tracker_;
    groundstate::servo::View desired_{};
    std::int64_t target_ = 0;
    Sight sight_{};  ///< of this cycle
    std::vector<Sight> sights_{};
    std::vector<Kept> kept_{};
    std::size_t keeping_ = 0;       ///< kept so far
    std::size_t keeping_next_ = 0;  ///< of this target
    std::int64_t target_came_ns_ = 0;
};

struct RobotSettings {
    std::int64_t most_age_ns = 100'000'000;  ///< of the image behind a twist; then the camera is brought to rest
    groundstate::kinematics::CameraMotionSettings motion{};
};

struct Motion {
    std::int64_t at_ns = 0;
    std::int64_t captured_ns = -1;  ///< of the image behind it; -1: none
    Vector6 measured{};
    Vector6 position{};
    Vector6 velocity{};
    double shortened = 1;
    unsigned held = 0;
    bool holding = true;
};

/// The machine says whether the camera follows the set-points; here its twist becomes positions and velocities of the joints.
class ArmController final : public RobotMachine {
  public:
    ArmController(Now now, const groundstate::kinematics::ArmModel& arm, const RobotSettings& settings, std::size_t motions);
    void before_sensors(const Cycle& cycle, const In& in) override;
    bool is_guided(const Cycle&) override { return is_guided_; }
    bool is_still(const Cycle&) override { return motion_.twist().isZero(0); }
    bool control(const Cycle& cycle, const In& in, Out& out) override;
    void arm(const Cycle&, ArmMode) override {}

    const std::vector<Motion>& motions() const noexcept { return motions_; }

  private:
    Now now_;
    groundstate::kinematics::CameraMotion motion_;
    RobotSettings settings_;
    std::int64_t now_ns_ = 0;  ///< when the sensors were asked
    std::int64_t last_ns_ = -1;
    bool is_guided_ = false;
    std::vector<Motion> motions_{};
};

struct Drive {
    std::int64_t at_ns = 0;
    std::int64_t captured_ns = -1;  ///< of the image behind the velocity; -1: none
    double fastest = 0;            ///< rad/s, of the joints
    bool holding = true;
};

/// Drives the joints along the set-points, and to rest if these are too old.
class JointDrives final : public Motor {
  public:
    using Command = std::function<void(std::int64_t now_ns, const Joints& velocity)>;
    JointDrives(Now now, Command command, const groundstate::kinematics::FollowerSettings& settings, std::size_t drives);
    bool drive(const Cycle& cycle, const In& in, Out& out) override;
    /// The joints stand: nobody leads them any more.
    void safe_stop() noexcept override;

    const std::vector<Drive>& drives() const noexcept { return drives_; }

  private:
    Now now_;
    Command command_;
    groundstate::kinematics::Follower<6> follower_;
    std::vector<Drive> drives_{};
};

/// Reads the encoders.
class JointEncoders final : public Encoder {
  public:
    using Read = std::function<Joints(std::int64_t now_ns)>;
    JointEncoders(Now now, Read read) : now_{std::move(now)}, read_{std::move(read)} {}
    bool acquire(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    Read read_;
};

}  // namespace controller_system
