// Builds controller and cell, runs them, and measures what they came to.
#include "closed_loop.hpp"

#include <limits>
#include <stdexcept>

#include <groundstate/simulated/camera.hpp>

namespace controller_system {

using namespace groundstate;

namespace {

// From a place, looking at the middle of the target; unturned the image's right is the target's x, straight from above.
Eigen::Isometry3d looking(const Eigen::Vector3d& from, double turn) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    const Eigen::Quaterniond aim = Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitZ(), -from);
    pose.linear() = aim.toRotationMatrix() * Eigen::AngleAxisd{M_PI, Eigen::Vector3d::UnitX()}.toRotationMatrix() *
                    Eigen::AngleAxisd{turn, Eigen::Vector3d::UnitZ()}.toRotationMatrix();
    pose.translation() = from;
    return pose;
}

// Visual servoing, which fails from some instant on, if it is to.
template <Clock C>
class FailingServoing final : public ServoingByImages {
  public:
    FailingServoing(C& clock, const LoopSettings& settings, Now now, const ServoingSettings& servoing, std::size_t sights)
        : ServoingByImages{std::move(now), servoing, sights}, clock_{clock}, fault_{settings.hook_fault},
          from_ns_{clock.now_ns() + static_cast<std::int64_t>(settings.hook_fails_s * 1e9)} {}

    bool set_point(const Cycle& cycle, const In& in, Out& out) override {
        const bool ready = ServoingByImages::set_point(cycle, in, out);
        if (clock_.now_ns() < from_ns_) {
            return ready;
        }
        switch (fault_) {
            case HookFault::none: break;
            case HookFault::throws: throw std::runtime_error{"the law has no solution"};
            case HookFault::hangs:
                for (MonotonicClock wall;;) {
                    wall.sleep_until_ns(wall.now_ns() + 1'000'000'000);
                }
            case HookFault::waits: clock_.sleep_until_ns(never_ns); break;
            case HookFault::not_a_number: out.vs_to_robot.twist[2] = std::numeric_limits<double>::quiet_NaN(); break;
        }
        return ready;
    }

  private:
    C& clock_;
    HookFault fault_;
    std::int64_t from_ns_;
};

template <Clock C>
Loop run(const LoopSettings& settings, C& clock) {
    Loop loop;
    loop.origin_ns = clock.now_ns();
    loop.cell = std::make_unique<Cell>(example_cell(settings.run.seed));
    Cell& cell = *loop.cell;
    const Now now = [&clock] { return clock.now_ns(); };
    loop.goals = settings.goals.empty() ? example_goals(settings.run.span_ns / 2) : settings.goals;
    const auto periods = [&](std::int64_t period_ns) { return static_cast<std::size_t>(settings.run.span_ns / period_ns + 10); };

    auto camera = simulated::Camera<C>::open(
        clock, cell.scene(), [&cell](std::int64_t at_ns) { return simulated_pose(cell.camera(at_ns)); },
        {.faults = closed_loop::faults(settings.disturbances, settings.run.seed, 100)});
    GoalSender sender{now, cell, loop.goals};
    ImageGrabber grabber{[&](FrameView into, Watchdog& watchdog) { return camera->grab(into, watchdog); }};
    ServoingSettings servoing;
    servoing.lens = cell.settings().lens;
    loop.servoing = std::make_unique<FailingServoing<C>>(clock, settings, now, servoing, periods(10'000'000));
    loop.robot = std::make_unique<ArmController>(now, kinematics::example_arm(), RobotSettings{}, periods(5'000'000));
    loop.motor = std::make_unique<JointDrives>(
        now, [&cell](std::int64_t at_ns, const Joints& velocity) { cell.drive(at_ns, velocity); }, kinematics::FollowerSettings{},
        periods(1'000'000));
    JointEncoders encoders{now, [&cell](std::int64_t at_ns) { return cell.measured(at_ns); }};

    loop.account = closed_loop::run_tasks<System>(
        clock, Hooks{sender, grabber, *loop.servoing, *loop.robot, *loop.motor, encoders}, settings.run);
    loop.frames = camera->account();
    const std::int64_t end_ns = loop.origin_ns + settings.run.span_ns;
    const Eigen::Isometry3d goal = cell.settings().target.pose * loop.goals.back().camera;
    const Eigen::Isometry3d apart = goal.inverse() * cell.camera(end_ns);
    loop.position_error = apart.translation().norm();
    loop.turn_error = Eigen::AngleAxisd{apart.linear()}.angle();
    if (!loop.servoing->sights().empty()) {
        loop.feature_error = loop.servoing->sights().back().command.error;
    }
    if (!loop.robot->motions().empty()) {
        loop.holding = loop.robot->motions().back().holding;
    }
    if (!loop.motor->drives().empty()) {
        loop.fastest = loop.motor->drives().back().fastest;
    }
    return loop;
}

}  // namespace

std::vector<Goal> example_goals(std::int64_t second_ns) {
    return {{0, looking({0, 0, 0.40}, 0)}, {second_ns, looking({0.08, -0.06, 0.33}, 0.5)}};
}

Loop run(const LoopSettings& settings) {
    return closed_loop::on_its_clock<System>(settings.run, [&](auto& clock) { return run(settings, clock); });
}

}  // namespace controller_system
