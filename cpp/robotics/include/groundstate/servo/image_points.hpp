// Points in the image: pixels, and the normalised coordinates that the servo law is stated in.
//
// The camera's frame has x to the right, y down, z ahead. A point (X, Y, Z) in it is seen at x = X/Z, y = Y/Z, and at the
// pixel u = fx x + cx, v = fy y + cy (Chaumette & Hutchinson, Visual servo control I, 2006, equations 5 and 6, without
// distortion). Nothing here allocates, blocks or throws.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace groundstate::servo {

/// A place in the image, in pixels; the centre of the first pixel is (0, 0).
struct Pixel {
    double u = 0;
    double v = 0;
};

/// A place in the image plane at distance 1: metres per metre of depth.
struct ImagePoint {
    double x = 0;
    double y = 0;
};

/// How a camera without distortion maps the image plane to pixels.
struct Intrinsics {
    double fx = 0;  ///< pixels
    double fy = 0;
    double cx = 0;
    double cy = 0;

    ImagePoint normalised(Pixel pixel) const noexcept { return {(pixel.u - cx) / fx, (pixel.v - cy) / fy}; }
    Pixel pixel(ImagePoint point) const noexcept { return {fx * point.x + cx, fy * point.y + cy}; }
};

/// The features of the law are four points, always in the same order.
inline constexpr std::size_t points = 4;
using Pixels = std::array<Pixel, points>;
using ImagePoints = std::array<ImagePoint, points>;
using Depths = std::array<double, points>;

inline ImagePoints normalised(const Intrinsics& camera, const Pixels& pixels) noexcept {
    ImagePoints result;
    for (std::size_t i = 0; i < points; ++i) {
        result[i] = camera.normalised(pixels[i]);
    }
    return result;
}

/// The area of the polygon through the points in their order, without its sign.
inline double area(const ImagePoints& polygon) noexcept {
    double twice = 0;
    for (std::size_t i = 0; i < points; ++i) {
        const ImagePoint& a = polygon[i];
        const ImagePoint& b = polygon[(i + 1) % points];
        twice += a.x * b.y - b.x * a.y;
    }
    return std::abs(twice) / 2;
}

}  // namespace groundstate::servo
