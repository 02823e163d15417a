// What a pinhole camera sees of discs in the world.
//
// World, pose and intrinsics in, pixels out: no time, no chance, no state between two drawings, so that a picture is a
// function of the pose. Each picture is drawn whole, in place: filling 640 × 480 bytes takes 5 µs, less than keeping
// count of what to erase in which of a buffer's arrays. The outline of a disc is a projected polygon, exact in
// perspective, and each pixel is mixed by how much of it is covered (OpenCV's antialiasing moves centres by 0.03 pixels).
//
// Camera: x to the right, y downwards, z ahead. Lengths in metres, angles in radians, pixels from the centre of the
// upper left one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <groundstate/frame.hpp>

namespace groundstate::simulated {

using Vector = std::array<double, 3>;

/// Where the camera is: a point in it, `p`, is `rotation * p + position` in the world. Rows of the matrix in order.
struct Pose {
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
    Vector position{};

    /// A point of the world as the camera has it.
    Vector into_camera(const Vector& world) const noexcept;
};

/// The lens: focal lengths and principal point in pixels, no distortion.
struct Intrinsics {
    double fx = 600;
    double fy = 600;
    double cx = 319.5;
    double cy = 239.5;
};

struct Pixel {
    double x = 0;
    double y = 0;
};

/// A flat disc, seen from both sides; nothing hides behind it.
struct Disc {
    Vector centre{};
    Vector normal{0, 0, 1};
    double radius = 0.02;
    std::uint8_t brightness = 230;
};

/// The rectangle of pixels from `left`, `top` on; it is empty where width or height are.
struct Box {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
};

class Coverage;

/// Discs before a background, drawn in their order.
class Scene {
  public:
    /// LIMIT: discs of one scene.
    static constexpr std::size_t most_discs = 64;

    /// Allocates: yes. At most `most_discs` discs are taken.
    explicit Scene(std::vector<Disc> discs, const Intrinsics& intrinsics = {}, std::uint8_t background = 40);
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    const std::vector<Disc>& discs() const noexcept { return discs_; }
    const Intrinsics& intrinsics() const noexcept { return intrinsics_; }
    std::uint8_t background() const noexcept { return background_; }

    /// Where a point of the world is in the picture, also beside its edge; nothing if it is not before the camera.
    std::optional<Pixel> project(const Vector& world, const Pose& camera) const noexcept;

    /// What bounds a disc in a picture of that shape: empty if nothing of it can be seen. Blocks: no. Allocates: no.
    Box bounds(std::size_t disc, const Pose& camera, const FrameShape& shape) const noexcept;

    /// Makes room for pictures of that shape. Allocates: yes.
    void prepare(const FrameShape& shape);

    /// Draws the whole picture. A disc that reaches behind the camera is left out.
    /// Who: one thread. Blocks: no. Allocates: not after `prepare` for that shape.
    /// Worst case: as many pixels as the picture and its discs have.
    void draw(const Pose& camera, FrameView into);

  private:
    static constexpr std::size_t corners = 32;
    using Outline = std::array<Vector, corners>;

    bool project_outline(std::size_t disc, const Pose& camera, std::array<Pixel, corners>& picture) const noexcept;

    std::vector<Disc> discs_;
    std::vector<Outline> outlines_;
    Intrinsics intrinsics_;
    std::uint8_t background_;
    std::unique_ptr<Coverage> coverage_;
};

}  // namespace groundstate::simulated
