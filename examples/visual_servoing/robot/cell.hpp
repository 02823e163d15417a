// The robot cell, instead of the real one: an arm with driven joints, a camera in its hand, and a target of four discs.
//
// It lives by the instants that it is told and never goes back. All of it depends on the seed and on what the controller
// does, on nothing else. Tasks of several threads look at it, each for less than some microseconds, behind a mutex: it
// stands for the world, which needs none.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include <groundstate/kinematics/arm.hpp>
#include <groundstate/plant/joint.hpp>
#include <groundstate/servo/visual_servo.hpp>
#include <groundstate/simulated/scene.hpp>

namespace controller_system {

using groundstate::kinematics::Joints;

/// The discs' centres lie on a square in a table's plane.
struct Target {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< in the base's frame; z points up from the table
    double half_side = 0.06;                                 ///< m
    double radius = 0.014;                                   ///< m
    Eigen::Vector3d centre(std::size_t disc) const;
};

struct CellSettings {
    groundstate::plant::JointSettings joint{.encoder_noise = 0.5};
    Joints start{};
    Target target{};
    groundstate::servo::Intrinsics lens{.fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};
    std::uint64_t seed = 1;
};

/// The arm over the table as the examples have it, the camera looking down at the target from aside.
CellSettings example_cell(std::uint64_t seed);

class Cell {
  public:
    explicit Cell(const CellSettings& settings);

    const CellSettings& settings() const noexcept { return settings_; }

    /// What the encoders read. Who: everybody. Allocates: no.
    Joints measured(std::int64_t now_ns);
    /// The drives are given velocities. Who: everybody. Allocates: no.
    void drive(std::int64_t now_ns, const Joints& velocity);

    /// Where the camera was at an instant of the last 250 ms. Who: everybody. Allocates: no.
    Eigen::Isometry3d camera(std::int64_t at_ns);
    Joints position(std::int64_t now_ns);

    /// What a camera with that pose sees of the target, without an image.
    groundstate::servo::View view(const Eigen::Isometry3d& camera) const;
    groundstate::simulated::Scene scene() const;

  private:
    void pass_until(std::int64_t now_ns);

    static constexpr std::int64_t step_ns = 250'000;
    static constexpr std::size_t remembered = 1000;

    CellSettings settings_;
    std::mutex mutex_{};
    groundstate::kinematics::Arm arm_;
    std::array<groundstate::plant::Joint, groundstate::kinematics::joints> joints_{};
    groundstate::plant::Random random_;
    std::int64_t step_ = -1;  ///< the last one that has passed; -1: time has not begun
    std::vector<Joints> past_{};
};

/// As the simulated camera has poses.
groundstate::simulated::Pose simulated_pose(const Eigen::Isometry3d& camera);

}  // namespace controller_system
