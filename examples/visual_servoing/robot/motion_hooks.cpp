// Robot, motor and encoder.
#include "hooks.hpp"

namespace visual_servoing {

using namespace groundstate;
using kinematics::joints;

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

double seconds(std::int64_t span_ns) { return static_cast<double>(span_ns) * 1e-9; }

// Goes towards what is wanted, by no more than so much.
template <class V>
V towards(const V& from, const V& to, double most) {
    const double way = (to - from).norm();
    return way <= most ? to : V{from + (to - from) * (most / way)};
}

}  // namespace

ArmController::ArmController(Now now, const kinematics::ArmModel& arm, const RobotSettings& settings, std::size_t motions)
    : now_{std::move(now)}, arm_{arm}, settings_{settings} {
    motions_.reserve(motions);
}

bool ArmController::control(const Cycle&, const In& in, Out& out) {
    if (!in.encoder_to_robot) {
        return false;
    }
    const std::int64_t now_ns = now_();
    const Joints measured = vector(in.encoder_to_robot->position);
    if (!started_) {
        set_point_ = measured;
        last_ns_ = now_ns;
        started_ = true;
    }
    const double dt = seconds(now_ns - last_ns_);
    last_ns_ = now_ns;

    Motion motion{.at_ns = now_ns, .measured = in.encoder_to_robot->position};
    servo::Twist wanted = servo::Twist::Zero();
    if (in.vs_to_robot && now_ns - in.vs_to_robot->captured_ns <= settings_.most_age_ns) {
        wanted = Eigen::Map<const servo::Twist>{in.vs_to_robot->twist.data()};
        motion.captured_ns = in.vs_to_robot->captured_ns;
        motion.holding = false;
    }
    twist_.head<3>() = towards<Eigen::Vector3d>(twist_.head<3>(), wanted.head<3>(), settings_.most_acceleration * dt);
    twist_.tail<3>() = towards<Eigen::Vector3d>(twist_.tail<3>(), wanted.tail<3>(), settings_.most_turning * dt);

    const auto moved =
        kinematics::joint_velocities(arm_.model().limits, {}, arm_.jacobian(set_point_), set_point_, twist_);
    set_point_ += moved.velocity * dt;
    set_point_ = measured + (set_point_ - measured).cwiseMax(-settings_.most_lag).cwiseMin(settings_.most_lag);
    for (std::size_t i = 0; i < joints; ++i) {
        const kinematics::JointLimit& limit = arm_.model().limits[i];
        double& position = set_point_[static_cast<Eigen::Index>(i)];
        position = std::clamp(position, limit.least, limit.most);
    }
    motion.position = values(set_point_);
    motion.velocity = values(moved.velocity);
    motion.shortened = moved.shortened;
    motion.held = moved.held;
    record(motions_, motion);

    out.robot_to_motor = {.position = motion.position,
                          .velocity = motion.velocity,
                          .set_ns = now_ns,
                          .captured_ns = motion.captured_ns};
    out.robot_to_vs = {.position = motion.measured,
                       .camera_twist = values(twist_),
                       .measured_ns = in.encoder_to_robot->measured_ns,
                       .holding = motion.holding};
    return true;
}

JointDrives::JointDrives(Now now, Command command, const MotorSettings& settings, std::size_t drives)
    : now_{std::move(now)}, command_{std::move(command)}, settings_{settings} {
    drives_.reserve(drives);
}

bool JointDrives::drive(const Cycle&, const In& in, Out&) {
    const std::int64_t now_ns = now_();
    const double dt = last_ns_ == 0 ? 0 : seconds(now_ns - last_ns_);
    last_ns_ = now_ns;
    Drive drive{.at_ns = now_ns};
    const bool known = in.encoder_to_motor && now_ns - in.encoder_to_motor->measured_ns <= settings_.most_age_ns;
    const bool led = in.robot_to_motor && now_ns - in.robot_to_motor->set_ns <= settings_.most_age_ns;
    if (known && led) {
        const RobotToMotor& set = *in.robot_to_motor;
        // Where the joint should have been when it was measured.
        const Joints planned =
            vector(set.position) + vector(set.velocity) * seconds(in.encoder_to_motor->measured_ns - set.set_ns);
        velocity_ = vector(set.velocity) + settings_.stiffness * (planned - vector(in.encoder_to_motor->position));
        velocity_ = velocity_.cwiseMax(-settings_.most_velocity).cwiseMin(settings_.most_velocity);
        drive.captured_ns = set.captured_ns;
        drive.holding = false;
    } else {
        const double most = settings_.braking * dt;
        velocity_ -= velocity_.cwiseMax(-most).cwiseMin(most);
    }
    drive.fastest = velocity_.cwiseAbs().maxCoeff();
    command_(now_ns, velocity_);
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

}  // namespace visual_servoing
