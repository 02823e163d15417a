// The interaction matrix of four points: how they move in the image when the camera moves.
//
// A point (x, y) at depth Z moves by L(x, y, Z) v when the camera has the twist v = (velocity, angular velocity) in its own
// frame (Chaumette & Hutchinson 2006, equation 11):
//
//     L = [ -1/Z    0   x/Z     xy    -(1+x^2)   y ]
//         [   0   -1/Z  y/Z   1+y^2     -xy     -x ]
//
// Four points give an 8x6 matrix, which has full rank unless the points are collinear. Points that lie behind the camera,
// coincide, or are not numbers give no law at all: that is said by `defect`, as a value.
#pragma once

#include <Eigen/Core>

#include "image_points.hpp"

namespace groundstate::servo {

/// (velocity in m/s, angular velocity in rad/s) of the camera, in its own frame.
using Twist = Eigen::Matrix<double, 6, 1>;
using InteractionMatrix = Eigen::Matrix<double, 2 * points, 6>;
using FeatureError = Eigen::Matrix<double, 2 * points, 1>;

/// What makes a set of points useless.
enum class Defect { none, not_finite, behind_camera, coincident, collinear };

/// Two points closer than this (in the image plane at distance 1) are one.
inline constexpr double distinct = 1e-4;
/// Points whose extent across their line is less than this share of the extent along it are collinear.
inline constexpr double flat = 1e-3;

/// Who: everybody. Blocks: no. Allocates: no.
inline Defect defect(const ImagePoints& seen, const Depths& depths) noexcept {
    Eigen::Matrix<double, 2, points> places;
    for (std::size_t i = 0; i < points; ++i) {
        if (!std::isfinite(seen[i].x) || !std::isfinite(seen[i].y) || !std::isfinite(depths[i])) {
            return Defect::not_finite;
        }
        if (depths[i] <= 0) {
            return Defect::behind_camera;
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (std::hypot(seen[i].x - seen[j].x, seen[i].y - seen[j].y) < distinct) {
                return Defect::coincident;
            }
        }
        places.col(static_cast<Eigen::Index>(i)) << seen[i].x, seen[i].y;
    }
    // The extents along the principal axes are the roots of the eigenvalues of the 2x2 matrix of second moments.
    const Eigen::Vector2d middle = places.rowwise().mean();
    const Eigen::Matrix2d moments = (places.colwise() - middle) * (places.colwise() - middle).transpose();
    const double half_trace = moments.trace() / 2;
    const double along = half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - moments.determinant()));
    const double across = moments.determinant() / along;
    return across < flat * flat * along ? Defect::collinear : Defect::none;
}

/// Who: everybody. Blocks: no. Allocates: no. The points have no defect.
inline InteractionMatrix interaction_matrix(const ImagePoints& seen, const Depths& depths) noexcept {
    InteractionMatrix result;
    for (std::size_t i = 0; i < points; ++i) {
        const auto [x, y] = seen[i];
        const double z = depths[i];
        const auto row = static_cast<Eigen::Index>(2 * i);
        result.row(row) << -1 / z, 0, x / z, x * y, -(1 + x * x), y;
        result.row(row + 1) << 0, -1 / z, y / z, 1 + y * y, -x * y, -x;
    }
    return result;
}

}  // namespace groundstate::servo
