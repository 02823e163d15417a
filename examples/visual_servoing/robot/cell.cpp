// The cell's time, kinematics and views.
#include "cell.hpp"

#include <algorithm>

namespace controller_system {

using namespace groundstate;
using kinematics::joints;

Eigen::Vector3d Target::centre(std::size_t disc) const {
    const double x = disc == 0 || disc == 3 ? -half_side : half_side;
    const double y = disc < 2 ? half_side : -half_side;
    return pose * Eigen::Vector3d{x, y, 0};
}

CellSettings example_cell(std::uint64_t seed) {
    CellSettings settings;
    settings.start << 0.126, 0.892, -2.599, 0.196, -1.537, 2.651;
    settings.target.pose.translation() << 0.55, 0.05, 0.0;
    settings.target.pose.linear() = Eigen::AngleAxisd{0.1, Eigen::Vector3d::UnitZ()}.toRotationMatrix();
    settings.seed = seed;
    return settings;
}

Cell::Cell(const CellSettings& settings)
    : settings_{settings}, arm_{kinematics::example_arm()}, random_{settings.seed}, past_(remembered, settings.start) {
    for (std::size_t i = 0; i < joints; ++i) {
        joints_[i] = {settings.joint, settings.start[static_cast<Eigen::Index>(i)]};
    }
}

void Cell::pass_until(std::int64_t now_ns) {
    const std::int64_t now = now_ns / step_ns;
    if (step_ < 0) {
        step_ = now;
        past_.assign(remembered, settings_.start);
    }
    for (; step_ < now; ++step_) {
        Joints& next = past_[static_cast<std::size_t>(step_ + 1) % remembered];
        for (std::size_t i = 0; i < joints; ++i) {
            joints_[i].pass(static_cast<double>(step_ns) * 1e-9);
            next[static_cast<Eigen::Index>(i)] = joints_[i].position();
        }
    }
}

Joints Cell::measured(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    Joints result;
    for (std::size_t i = 0; i < joints; ++i) {
        result[static_cast<Eigen::Index>(i)] = joints_[i].measured(random_);
    }
    return result;
}

void Cell::drive(std::int64_t now_ns, const Joints& velocity) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    for (std::size_t i = 0; i < joints; ++i) {
        joints_[i].command(velocity[static_cast<Eigen::Index>(i)]);
    }
}

Eigen::Isometry3d Cell::camera(std::int64_t at_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(at_ns);
    const std::int64_t oldest = std::max<std::int64_t>(0, step_ - static_cast<std::int64_t>(remembered) + 1);
    const std::int64_t step = std::clamp(at_ns / step_ns, oldest, step_);
    return arm_.camera(past_[static_cast<std::size_t>(step) % remembered]);
}

Joints Cell::position(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    return past_[static_cast<std::size_t>(step_) % remembered];
}

servo::View Cell::view(const Eigen::Isometry3d& camera) const {
    servo::View view;
    for (std::size_t i = 0; i < servo::points; ++i) {
        const Eigen::Vector3d p = camera.inverse() * settings_.target.centre(i);
        view.seen[i] = {p.x() / p.z(), p.y() / p.z()};
        view.depths[i] = p.z();
    }
    return view;
}

simulated::Scene Cell::scene() const {
    const Eigen::Vector3d up = settings_.target.pose.linear().col(2);
    std::vector<simulated::Disc> discs;
    for (std::size_t i = 0; i < servo::points; ++i) {
        const Eigen::Vector3d centre = settings_.target.centre(i);
        discs.push_back({.centre = {centre.x(), centre.y(), centre.z()},
                         .normal = {up.x(), up.y(), up.z()},
                         .radius = settings_.target.radius});
    }
    const servo::Intrinsics& lens = settings_.lens;
    return simulated::Scene{std::move(discs), {.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}};
}

simulated::Pose simulated_pose(const Eigen::Isometry3d& camera) {
    simulated::Pose pose;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            pose.rotation[static_cast<std::size_t>(3 * row + column)] = camera.linear()(row, column);
        }
        pose.position[static_cast<std::size_t>(row)] = camera.translation()[row];
    }
    return pose;
}

}  // namespace controller_system
