// The head and the object, instead of the real ones: two driven joints that turn a camera, and a ball that swings before it.
//
// As a disc is drawn from a pose, the camera's pose is told in a frame that goes with the object. What the object does
// depends on the time alone.
#pragma once

#include <mutex>
#include <vector>

#include <Eigen/Geometry>

#include <groundstate/plant/joint.hpp>
#include <groundstate/servo/image_points.hpp>
#include <groundstate/simulated/scene.hpp>

#include "data.hpp"

namespace tracking_system {

inline constexpr groundstate::servo::Intrinsics lens{.fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};

/// Where the camera looks with these angles: its axes in the base's frame (x ahead, y to the left, z up).
Eigen::Matrix3d looking(const Angles& head);

/// The angles under which a point of the image is seen.
Angles direction(const Angles& head, groundstate::servo::ImagePoint seen);

/// Where a direction is seen in the image; it is before the camera.
groundstate::servo::ImagePoint seen_from(const Angles& head, const Angles& direction);

class Scenery {
  public:
    explicit Scenery(std::uint64_t seed);

    static Eigen::Vector3d object(double seconds);
    groundstate::simulated::Scene scene() const;

    // Who: everybody. Allocate: no.
    Angles measured(std::int64_t now_ns);
    void drive(std::int64_t now_ns, const Angles& velocity);
    groundstate::simulated::Pose camera_from_object(std::int64_t at_ns);
    /// Pixels between the object and the middle of the image at this instant.
    double off_centre(std::int64_t now_ns);

  private:
    void pass_until(std::int64_t now_ns);
    Angles position(std::int64_t at_ns) const;

    static constexpr std::int64_t step_ns = 250'000;
    static constexpr std::size_t remembered = 400;

    std::mutex mutex_{};
    std::array<groundstate::plant::Joint, 2> joints_{};
    groundstate::plant::Random random_;
    std::int64_t origin_ns_ = -1;
    std::int64_t step_ = 0;
    std::vector<Angles> past_{};
};

}  // namespace tracking_system
