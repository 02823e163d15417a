// From wanted twists of the camera to set-points of the joints: ramps, kinematics, limits, one cycle after the other.
//
// The twist follows what is wanted with bounded acceleration, so that a twist that comes late, or not at all, never jerks
// the arm. Set-points are integrated, not measured: noise of the encoders does not come back in.
#pragma once

#include "joint_velocities.hpp"

namespace groundstate::kinematics {

struct CameraMotionSettings {
    double most_acceleration = 1.0;  ///< of the camera, m/s^2
    double most_turning = 4.0;       ///< rad/s^2
    double most_lag = 0.1;           ///< rad between set-point and joint, before the set-point waits for it
    DampingSettings damping{};
};

/// Who: one thread. Nothing blocks or allocates after it is built.
class CameraMotion {
  public:
    using Twist = Eigen::Matrix<double, 6, 1>;

    explicit CameraMotion(const ArmModel& arm, const CameraMotionSettings& settings = {})
        : arm_{arm}, settings_{settings} {}

    /// The next set-point, `dt` seconds after the one before; the first one is where the arm is.
    const JointVelocities& step(const Joints& measured, const Twist& wanted, double dt) {
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

    const Joints& position() const noexcept { return position_; }
    const Joints& velocity() const noexcept { return moved_.velocity; }
    const Twist& twist() const noexcept { return twist_; }
    Arm& arm() noexcept { return arm_; }

  private:
    // Goes towards what is wanted, by no more than so much.
    static Eigen::Vector3d towards(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double most) noexcept {
        const double way = (to - from).norm();
        return way <= most ? to : Eigen::Vector3d{from + (to - from) * (most / way)};
    }

    Arm arm_;
    CameraMotionSettings settings_;
    Twist twist_ = Twist::Zero();
    Joints position_ = Joints::Zero();
    JointVelocities moved_{};
    bool started_ = false;
};

}  // namespace groundstate::kinematics
