// Time, jaw and pictures of the table.
#include "table.hpp"

namespace placing_system {

using namespace groundstate;

Eigen::Isometry3d camera_above() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 0.5, 0, 1.2;
    pose.linear() << 0, -1, 0, -1, 0, 0, 0, 0, -1;
    return pose;
}

Place on_table(servo::Pixel pixel) {
    const servo::ImagePoint point = lens.normalised(pixel);
    const Eigen::Isometry3d camera = camera_above();
    const Eigen::Vector3d ray = camera.linear() * Eigen::Vector3d{point.x, point.y, 1};
    const Eigen::Vector3d hit = camera.translation() - ray * (camera.translation().z() / ray.z());
    return {hit.x(), hit.y()};
}

kinematics::ArmModel arm_with_tool() {
    kinematics::ArmModel arm = kinematics::example_arm();
    arm.camera_mount.translation().z() = 0.12;
    return arm;
}

Joints beginning() {
    Joints position;
    position << 0.37, 1.14, -3.0, 0.0, -1.25, 0.3;
    return position;
}

Table::Table(std::vector<Place> parts, double slip, std::uint64_t seed)
    : random_{seed}, parts_{std::move(parts)}, slip_{slip} {
    for (std::size_t i = 0; i < kinematics::joints; ++i) {
        joints_[i] = {{.encoder_noise = 0.5}, beginning()[static_cast<Eigen::Index>(i)]};
    }
}

Eigen::Vector3d Table::tip() {
    Joints position;
    for (std::size_t i = 0; i < kinematics::joints; ++i) {
        position[static_cast<Eigen::Index>(i)] = joints_[i].position();
    }
    return arm_.camera(position).translation();
}

void Table::pass_until(std::int64_t now_ns) {
    const std::int64_t now = now_ns / step_ns;
    step_ = step_ < 0 ? now : step_;
    for (; step_ < now; ++step_) {
        for (plant::Joint& joint : joints_) {
            joint.pass(static_cast<double>(step_ns) * 1e-9);
        }
    }
}

Joints Table::measured(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    Joints result;
    for (std::size_t i = 0; i < kinematics::joints; ++i) {
        result[static_cast<Eigen::Index>(i)] = joints_[i].measured(random_);
    }
    return result;
}

void Table::drive(std::int64_t now_ns, const Joints& velocity) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    for (std::size_t i = 0; i < kinematics::joints; ++i) {
        joints_[i].command(velocity[static_cast<Eigen::Index>(i)]);
    }
}

Feel Table::jaw(std::int64_t now_ns, bool closed) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    if (closed != ordered_closed_) {
        ordered_closed_ = closed;
        ordered_ns_ = now_ns;
        gripped_ = false;
    }
    const Eigen::Vector3d at = tip();
    const bool is_there = now_ns - ordered_ns_ >= jaw_ns;
    if (is_there && !gripped_) {
        gripped_ = true;
        if (!closed && held_ >= 0) {
            parts_[static_cast<std::size_t>(held_)] = {at.x(), at.y()};
            held_ = -1;
        }
        for (std::size_t i = 0; closed && held_ < 0 && i < parts_.size(); ++i) {
            if (at.z() < 0.02 && std::hypot(parts_[i].x - at.x(), parts_[i].y - at.y()) < 0.006) {
                if (random_.happens(slip_)) {
                    parts_[i].x += 0.012;
                    ++slips_;
                    break;
                }
                held_ = static_cast<int>(i);
            }
        }
    }
    if (!is_there) {
        return Feel::BETWEEN;
    }
    if (!closed) {
        return Feel::WIDE;
    }
    return held_ >= 0 ? Feel::AROUND : Feel::SHUT;
}

std::vector<Place> Table::parts() {
    const std::lock_guard guard{mutex_};
    return parts_;
}

void Table::draw(std::int64_t now_ns, FrameView into) {
    std::vector<simulated::Disc> discs;
    {
        const std::lock_guard guard{mutex_};
        pass_until(now_ns);
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const Eigen::Vector3d at =
                static_cast<int>(i) == held_ ? tip() : Eigen::Vector3d{parts_[i].x, parts_[i].y, 0};
            discs.push_back({.centre = {at.x(), at.y(), at.z()}, .radius = part_radius});
        }
    }
    simulated::Scene scene{std::move(discs), {.fx = lens.fx, .fy = lens.fy, .cx = lens.cx, .cy = lens.cy}};
    scene.prepare(into.shape);
    const Eigen::Isometry3d camera = camera_above();
    simulated::Pose pose;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            pose.rotation[static_cast<std::size_t>(3 * row + column)] = camera.linear()(row, column);
        }
        pose.position[static_cast<std::size_t>(row)] = camera.translation()[row];
    }
    scene.draw(pose, into);
}

}  // namespace placing_system
