// Robot, motor and encoder.
#include "hooks.hpp"

namespace controller_system {

using namespace groundstate;

namespace {

Joints vector(const Vector6& values) { return Joints{values.data()}; }

Vector6 values(const Joints& vector) {
    Vector6 result;
    Joints::Map(result.data()) = vector;
    return result;
}

template <class T>
void record(std::vector<T>& recording, const T& entry) {
    if (recording.size() < recording.capacity()) {
        recording.push_back(entry);
    }
}

}  // namespace

ArmController::ArmController(Now now, const kinematics::ArmModel& arm, const RobotSettings& settings, std::size_t motions)
    : now_{std::move(now)}, motion_{arm, settings.motion}, settings_{settings} {
    motions_.reserve(motions);
}

void ArmController::before_sensors(const Cycle&, const In& in) {
    now_ns_ = now_();
    is_guided_ = in.encoder_to_robot && in.vs_to_robot && now_ns_ - in.vs_to_robot->captured_ns <= settings_.most_age_ns;
}

bool ArmController::control(const Cycle& cycle, const In& in, Out& out) {
    RobotMachine::control(cycle, in, out);
    if (!in.encoder_to_robot) {
        return false;
    }
    const std::int64_t now_ns = now_ns_;
    const double dt = last_ns_ < 0 ? 0 : static_cast<double>(now_ns - last_ns_) * 1e-9;
    last_ns_ = now_ns;

    Motion motion{.at_ns = now_ns, .measured = in.encoder_to_robot->position};
    servo::Twist wanted = servo::Twist::Zero();
    if (out.arm.value() == ArmMode::FOLLOWING) {
        wanted = Eigen::Map<const servo::Twist>{in.vs_to_robot->twist.data()};
        motion.captured_ns = in.vs_to_robot->captured_ns;
        motion.holding = false;
    }
    const kinematics::JointVelocities& moved = motion_.step(vector(motion.measured), wanted, dt);
    motion.position = values(motion_.position());
    motion.velocity = values(moved.velocity);
    motion.shortened = moved.shortened;
    motion.held = moved.held;
    record(motions_, motion);

    out.robot_to_motor = {.position = motion.position,
                          .velocity = motion.velocity,
                          .set_ns = now_ns,
                          .captured_ns = motion.captured_ns};
    out.robot_to_vs = {.position = motion.measured,
                       .camera_twist = values(motion_.twist()),
                       .measured_ns = in.encoder_to_robot->measured_ns,
                       .holding = motion.holding};
    return true;
}

JointDrives::JointDrives(Now now, Command command, const kinematics::FollowerSettings& settings, std::size_t drives)
    : now_{std::move(now)}, command_{std::move(command)}, follower_{settings} {
    drives_.reserve(drives);
}

void JointDrives::safe_stop() noexcept { command_(now_(), Joints::Zero()); }

bool JointDrives::drive(const Cycle&, const In& in, Out&) {
    const std::int64_t now_ns = now_();
    Drive drive{.at_ns = now_ns};
    follower_.begin(now_ns);
    Joints velocity;
    if (in.encoder_to_motor && follower_.is_fresh(in.encoder_to_motor->measured_ns) && in.robot_to_motor &&
        follower_.is_fresh(in.robot_to_motor->set_ns)) {
        const RobotToMotor& set = *in.robot_to_motor;
        velocity = follower_.follow(vector(set.position), vector(set.velocity), set.set_ns,
                                    vector(in.encoder_to_motor->position), in.encoder_to_motor->measured_ns);
        drive.captured_ns = set.captured_ns;
        drive.holding = false;
    } else {
        velocity = follower_.brake();
    }
    drive.fastest = velocity.cwiseAbs().maxCoeff();
    command_(now_ns, velocity);
    record(drives_, drive);
    return true;
}

bool JointEncoders::acquire(const Cycle&, const In&, Out& out) {
    const std::int64_t now_ns = now_();
    const Vector6 position = values(read_(now_ns));
    out.encoder_to_robot = {position, now_ns};
    out.encoder_to_motor = {position, now_ns};
    return true;
}

}  // namespace controller_system
