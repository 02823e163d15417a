// One cycle of the camera's motion.
#include "groundstate/kinematics/camera_motion.hpp"

#include <algorithm>

namespace groundstate::kinematics {

namespace {

// Goes towards what is wanted, by no more than so much.
Eigen::Vector3d towards(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double most) noexcept {
    const double way = (to - from).norm();
    return way <= most ? to : Eigen::Vector3d{from + (to - from) * (most / way)};
}

}  // namespace

const JointVelocities& CameraMotion::step(const Joints& measured, const Twist& wanted, double dt) {
    if (!started_) {
        position_ = measured;
        started_ = true;
    }
    twist_.head<3>() = towards(twist_.head<3>(), wanted.head<3>(), settings_.most_acceleration * dt);
    twist_.tail<3>() = towards(twist_.tail<3>(), wanted.tail<3>(), settings_.most_turning * dt);
    const std::array<JointLimit, joints>& limits = arm_.model().limits;
    moved_ = joint_velocities(limits, settings_.damping, arm_.jacobian(position_), position_, twist_);
    position_ += moved_.velocity * dt;
    position_ = measured + (position_ - measured).cwiseMax(-settings_.most_lag).cwiseMin(settings_.most_lag);
    for (std::size_t i = 0; i < joints; ++i) {
        double& position = position_[static_cast<Eigen::Index>(i)];
        position = std::clamp(position, limits[i].least, limits[i].most);
    }
    return moved_;
}

}  // namespace groundstate::kinematics
