// The arm, the jaw, the parts on the table and the camera above, instead of the real ones.
//
// A jaw that closes around a part takes it along; one that opens leaves it where the tool is. A seeded share of the grips
// pushes the part aside instead. It lives by the instants that it is told.
#pragma once

#include <mutex>
#include <vector>

#include <groundstate/kinematics/arm.hpp>
#include <groundstate/plant/joint.hpp>
#include <groundstate/servo/image_points.hpp>
#include <groundstate/simulated/scene.hpp>

#include "data.hpp"
#include "generated/messages.hpp"

namespace placing_system {

using groundstate::kinematics::Joints;

inline constexpr double part_radius = 0.018;  // m
inline constexpr groundstate::servo::Intrinsics lens{.fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};

/// Looks straight down from 1.2 m, the image's right along the base's -y, its top along x.
Eigen::Isometry3d camera_above();

/// Where a point of the image lies on the table.
Place on_table(groundstate::servo::Pixel pixel);

/// The arm with the tool's tip in place of the camera, and where it begins.
groundstate::kinematics::ArmModel arm_with_tool();
Joints beginning();

class Table {
  public:
    Table(std::vector<Place> parts, double slip, std::uint64_t seed);

    // Who: everybody.
    Joints measured(std::int64_t now_ns);
    void drive(std::int64_t now_ns, const Joints& velocity);
    /// The jaw, whose valve closes it or not: what its sensor feels.
    Feel jaw(std::int64_t now_ns, bool closed);
    std::vector<Place> parts();
    long slips() const noexcept { return slips_; }

    /// What the camera sees now. Who: the camera's task. Allocates: yes, as the scene changes.
    void draw(std::int64_t now_ns, groundstate::FrameView into);

  private:
    void pass_until(std::int64_t now_ns);
    Eigen::Vector3d tip();

    static constexpr std::int64_t step_ns = 250'000;
    static constexpr std::int64_t jaw_ns = 80'000'000;

    std::mutex mutex_{};
    groundstate::kinematics::Arm arm_{arm_with_tool()};
    std::array<groundstate::plant::Joint, groundstate::kinematics::joints> joints_{};
    groundstate::plant::Random random_;
    std::vector<Place> parts_;
    double slip_;
    long slips_ = 0;
    int held_ = -1;  ///< the part in the jaw
    bool ordered_closed_ = false;
    bool gripped_ = false;  ///< the jaw's closing has had its effect
    std::int64_t ordered_ns_ = 0;
    std::int64_t step_ = -1;
};

}  // namespace placing_system
