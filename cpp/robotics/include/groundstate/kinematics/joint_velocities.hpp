// From the camera's twist to the joints' velocities: damped least squares within the joints' limits.
//
// q' = J^T (J J^T + d^2 I)^-1 v, with d growing from 0 to `damping` as the smallest singular value of J falls below
// `damp_below` (Nakamura & Hanafusa 1986): far from singular positions the twist is met exactly. A joint that would leave
// its range is held, and the others take over what they can. Velocities beyond the limits are shortened as a whole, so that
// the camera's direction is kept. INVARIANT: the result is within the limits, for every finite twist.
#pragma once

#include "arm.hpp"

namespace groundstate::kinematics {

struct DampingSettings {
    double damp_below = 0.05;
    double damping = 0.05;
    double margin_s = 0.15;  ///< within so much time the range's end is approached no faster than it could be left
};

struct JointVelocities {
    Joints velocity = Joints::Zero();
    double shortened = 1;       ///< the factor that the velocity limits took
    double least_singular = 0;  ///< of the whole Jacobian
    unsigned held = 0;          ///< bit i: joint i is held at the end of its range
};

/// The factor that brings velocities within the limits, at most 1.
double shortened(const std::array<JointLimit, joints>& limits, const Joints& velocity) noexcept;

/// Who: everybody. Blocks: no. Allocates: no.
JointVelocities joint_velocities(const std::array<JointLimit, joints>& limits, const DampingSettings& settings,
                                 const Jacobian& jacobian, const Joints& position,
                                 const Eigen::Matrix<double, 6, 1>& twist) noexcept;

}  // namespace groundstate::kinematics
