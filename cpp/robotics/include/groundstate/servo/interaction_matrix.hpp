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
Defect defect(const ImagePoints& seen, const Depths& depths) noexcept;

/// Who: everybody. Blocks: no. Allocates: no. The points have no defect.
InteractionMatrix interaction_matrix(const ImagePoints& seen, const Depths& depths) noexcept;

}  // namespace groundstate::servo
