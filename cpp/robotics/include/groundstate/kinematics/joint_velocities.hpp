// From the camera's twist to the joints' velocities: damped least squares within the joints' limits.
//
// q' = J^T (J J^T + d^2 I)^-1 v, with d growing from 0 to `damping` as the smallest singular value of J falls below
// `damp_below` (Nakamura & Hanafusa 1986): far from singular positions the twist is met exactly. A joint that would leave
// its range is held, and the others take over what they can. Velocities beyond the limits are shortened as a whole, so that
// the camera's direction is kept. INVARIANT: the result is within the limits, for every finite twist.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

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
inline double shortened(const std::array<JointLimit, joints>& limits, const Joints& velocity) noexcept {
    double factor = 1;
    for (std::size_t i = 0; i < joints; ++i) {
        const double speed = std::abs(velocity[static_cast<Eigen::Index>(i)]);
        if (speed * factor > limits[i].most_velocity) {
            factor = limits[i].most_velocity / speed;
        }
    }
    return factor;
}

/// Who: everybody. Blocks: no. Allocates: no.
inline JointVelocities joint_velocities(const std::array<JointLimit, joints>& limits, const DampingSettings& settings,
                                        const Jacobian& jacobian, const Joints& position,
                                        const Eigen::Matrix<double, 6, 1>& twist) noexcept {
    using Square = Eigen::Matrix<double, 6, 6>;
    JointVelocities result;
    Jacobian free = jacobian;
    for (std::size_t pass = 0; pass <= joints; ++pass) {
        const Square gram = free * free.transpose();
        const Eigen::SelfAdjointEigenSolver<Square> spectrum{gram, Eigen::EigenvaluesOnly};
        const double least = std::sqrt(std::max(0.0, spectrum.eigenvalues()[0]));
        if (pass == 0) {
            result.least_singular = least;
        }
        const double nearness = std::max(0.0, 1 - least / settings.damp_below);
        const double damping = settings.damping * nearness;
        // The eigenvalues of held joints are gone; what is left is damped.
        const Square damped = gram + (damping * damping + 1e-12) * Square::Identity();
        result.velocity = free.transpose() * damped.ldlt().solve(twist);

        result.shortened = shortened(limits, result.velocity);
        result.velocity *= result.shortened;

        const unsigned before = result.held;
        for (std::size_t i = 0; i < joints; ++i) {
            const auto j = static_cast<Eigen::Index>(i);
            const double room = result.velocity[j] > 0 ? limits[i].most - position[j] : position[j] - limits[i].least;
            if (std::abs(result.velocity[j]) * settings.margin_s > room && result.velocity[j] != 0) {
                result.held |= 1u << i;
                free.col(j).setZero();
            }
        }
        if (result.held == before) {
            break;
        }
    }
    return result;
}

}  // namespace groundstate::kinematics
