// How the object swings, and what it looks like from the head.
#include "scenery.hpp"

#include <algorithm>

namespace tracking_system {

using namespace groundstate;

Eigen::Matrix3d looking(const Angles& head) {
    // The camera's x to the right, y down, z ahead.
    Eigen::Matrix3d straight;
    straight << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    return (Eigen::AngleAxisd{head[0], Eigen::Vector3d::UnitZ()} * Eigen::AngleAxisd{-head[1], Eigen::Vector3d::UnitY()})
               .toRotationMatrix() *
           straight;
}

Angles direction(const Angles& head, servo::ImagePoint seen) {
    const Eigen::Vector3d ray = looking(head) * Eigen::Vector3d{seen.x, seen.y, 1};
    return {std::atan2(ray.y(), ray.x()), std::atan2(ray.z(), std::hypot(ray.x(), ray.y()))};
}

servo::ImagePoint seen_from(const Angles& head, const Angles& at) {
    const Eigen::Vector3d ray{std::cos(at[1]) * std::cos(at[0]), std::cos(at[1]) * std::sin(at[0]), std::sin(at[1])};
    const Eigen::Vector3d p = looking(head).transpose() * ray;
    return {p.x() / p.z(), p.y() / p.z()};
}

Scenery::Scenery(std::uint64_t seed) : random_{seed}, past_(remembered) {
    for (plant::Joint& joint : joints_) {
        joint = {{.lag_s = 0.006, .most_acceleration = 40, .encoder_noise = 0.5}, 0};
    }
}

Eigen::Vector3d Scenery::object(double seconds) {
    return {2.0, 0.25 + 0.8 * std::sin(1.1 * seconds), 0.1 + 0.4 * std::sin(1.7 * seconds)};
}

simulated::Scene Scenery::scene() const {
    return simulated::Scene{{{.centre = {0, 0, 0}, .normal = {-1, 0, 0}, .radius = 0.06}},
                            {.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}};
}

void Scenery::pass_until(std::int64_t now_ns) {
    if (origin_ns_ < 0) {
        origin_ns_ = now_ns;
    }
    for (const std::int64_t now = (now_ns - origin_ns_) / step_ns; step_ < now; ++step_) {
        Angles& next = past_[static_cast<std::size_t>(step_ + 1) % remembered];
        for (std::size_t i = 0; i < 2; ++i) {
            joints_[i].pass(static_cast<double>(step_ns) * 1e-9);
            next[i] = joints_[i].position();
        }
    }
}

Angles Scenery::position(std::int64_t at_ns) const {
    const std::int64_t oldest = std::max<std::int64_t>(0, step_ - static_cast<std::int64_t>(remembered) + 1);
    const std::int64_t step = std::clamp((at_ns - origin_ns_) / step_ns, oldest, step_);
    return past_[static_cast<std::size_t>(step) % remembered];
}

Angles Scenery::measured(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    return {joints_[0].measured(random_), joints_[1].measured(random_)};
}

void Scenery::drive(std::int64_t now_ns, const Angles& velocity) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    joints_[0].command(velocity[0]);
    joints_[1].command(velocity[1]);
}

simulated::Pose Scenery::camera_from_object(std::int64_t at_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(at_ns);
    const Eigen::Matrix3d axes = looking(position(at_ns));
    const Eigen::Vector3d place = -object(static_cast<double>(at_ns - origin_ns_) * 1e-9);
    simulated::Pose pose;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            pose.rotation[static_cast<std::size_t>(3 * row + column)] = axes(row, column);
        }
        pose.position[static_cast<std::size_t>(row)] = place[row];
    }
    return pose;
}

double Scenery::off_centre(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    const Eigen::Vector3d p =
        looking(position(now_ns)).transpose() * object(static_cast<double>(now_ns - origin_ns_) * 1e-9);
    return p.z() > 0 ? std::hypot(lens.fx * p.x() / p.z(), lens.fy * p.y() / p.z()) : 1e9;
}

}  // namespace tracking_system
