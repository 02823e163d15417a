// A square of four points in the plane z = 0 and a camera that flies freely: the tests' simplest world.
#pragma once

#include <Eigen/Geometry>

#include "groundstate/plant/random.hpp"
#include "groundstate/servo/visual_servo.hpp"

namespace groundstate::servo {

inline constexpr double half_side = 0.06;

inline Eigen::Vector3d corner(std::size_t i) {
    return {i == 0 || i == 3 ? -half_side : half_side, i < 2 ? -half_side : half_side, 0};
}

/// The camera's pose in the world, turned by a rotation vector.
inline Eigen::Isometry3d pose(const Eigen::Vector3d& place, const Eigen::Vector3d& turn) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    result.translation() = place;
    if (turn.norm() > 0) {
        result.linear() = Eigen::AngleAxisd{turn.norm(), turn.normalized()}.toRotationMatrix();
    }
    return result;
}

inline Eigen::Isometry3d moved(const Eigen::Isometry3d& camera, const Twist& twist, double dt) {
    // The exponential of the twist (Murray, Li & Sastry 1994, equation 2.36).
    const Eigen::Vector3d w = twist.tail<3>() * dt;
    const Eigen::Vector3d v = twist.head<3>() * dt;
    const double angle = w.norm();
    Eigen::Isometry3d step = pose(v, w);
    if (angle > 1e-12) {
        const Eigen::Vector3d axis = w / angle;
        step.translation() = axis.dot(v) * axis + (axis.cross(v) - step.linear() * axis.cross(v)) / angle;
    }
    return camera * step;
}

inline View seen_square(const Eigen::Isometry3d& camera) {
    View view;
    for (std::size_t i = 0; i < points; ++i) {
        const Eigen::Vector3d p = camera.inverse() * corner(i);
        view.seen[i] = {p.x() / p.z(), p.y() / p.z()};
        view.depths[i] = p.z();
    }
    return view;
}

/// A pose from which the square is seen and the law is expected to converge.
inline Eigen::Isometry3d somewhere(plant::Random& random) {
    const auto between = [&](double least, double most) { return least + (most - least) * random.uniform(); };
    return pose({between(-0.15, 0.15), between(-0.15, 0.15), between(-0.9, -0.4)},
                {between(-0.3, 0.3), between(-0.3, 0.3), between(-0.9, 0.9)});
}

}  // namespace groundstate::servo
