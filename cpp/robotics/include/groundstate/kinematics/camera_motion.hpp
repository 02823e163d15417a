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
    const JointVelocities& step(const Joints& measured, const Twist& wanted, double dt);

    const Joints& position() const noexcept { return position_; }
    const Joints& velocity() const noexcept { return moved_.velocity; }
    const Twist& twist() const noexcept { return twist_; }
    Arm& arm() noexcept { return arm_; }

  private:
    Arm arm_;
    CameraMotionSettings settings_;
    Twist twist_ = Twist::Zero();
    Joints position_ = Joints::Zero();
    JointVelocities moved_{};
    bool started_ = false;
};

}  // namespace groundstate::kinematics
