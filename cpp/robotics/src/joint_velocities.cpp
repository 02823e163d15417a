// Damped least squares, joint after joint that is held.
#include "groundstate/kinematics/joint_velocities.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace groundstate::kinematics {

double shortened(const std::array<JointLimit, joints>& limits, const Joints& velocity) noexcept {
    double factor = 1;
    for (std::size_t i = 0; i < joints; ++i) {
        const double speed = std::abs(velocity[static_cast<Eigen::Index>(i)]);
        if (speed * factor > limits[i].most_velocity) {
            factor = limits[i].most_velocity / speed;
        }
    }
    return factor;
}

JointVelocities joint_velocities(const std::array<JointLimit, joints>& limits, const DampingSettings& settings,
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
