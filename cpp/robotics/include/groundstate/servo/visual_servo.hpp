// Image-based visual servoing: from where four points are seen and where they should be seen to the camera's twist.
//
// With e = s - s*, the difference of the points' normalised coordinates, the law is v = -gain L^+ e (Chaumette &
// Hutchinson 2006, equation 5 of section II). Three choices of L are usual: at the present points, at the desired ones, and
// the mean of both (their section III-B). Near a singularity the inverse is damped (Nakamura & Hanafusa 1986): singular
// values below `damp_below` are inverted as s / (s^2 + d^2), with d growing to `damping`; elsewhere L^+ is exact. A twist
// beyond the limits is shortened as a whole, so the camera's direction is kept.
//
// What gives no twist is refused, as a value. INVARIANT: a twist is finite and within the limits.
#pragma once

#include <algorithm>

#include <Eigen/Eigenvalues>

#include "interaction_matrix.hpp"

namespace groundstate::servo {

/// Where L is taken.
enum class Interaction { current, desired, mean };

/// The gain falls with the largest component of L^+ e, from `at_zero` to `at_infinity` (1/s), with the slope
/// `slope_at_zero`, as ViSP's vpAdaptiveGain. Equal ends: a constant.
struct Gain {
    double at_zero = 1;
    double at_infinity = 1;
    double slope_at_zero = 0;

    double operator()(double way) const noexcept {
        const double range = at_zero - at_infinity;
        return range == 0 ? at_zero : range * std::exp(-slope_at_zero / range * way) + at_infinity;
    }
};

struct ServoSettings {
    Gain gain{};
    Interaction interaction = Interaction::mean;
    double damp_below = 1e-3;     ///< singular value of L
    double damping = 1e-3;        ///< d where a singular value is 0
    double most_velocity = 0.25;  ///< m/s
    double most_turning = 0.8;    ///< rad/s
};

/// Why there is no twist: the points seen, or those desired, have a defect.
enum class Refusal { none, seen, desired };

/// A control step's result; the twist is 0 if it was refused.
struct Command {
    Twist twist = Twist::Zero();
    double error = 0;      ///< |e|, in the image plane at distance 1
    double shortened = 1;  ///< the factor that the limits took
    Refusal refusal = Refusal::none;
    Defect defect = Defect::none;

    explicit operator bool() const noexcept { return refusal == Refusal::none; }
};

/// Where the points are to be seen, and how deep they lie then.
struct View {
    ImagePoints seen{};
    Depths depths{};
};

/// The factor that brings a twist within the limits, at most 1.
inline double within(const Twist& twist, double most_velocity, double most_turning) noexcept {
    const double velocity = twist.head<3>().norm();
    const double turning = twist.tail<3>().norm();
    double factor = 1;
    if (velocity > most_velocity) {
        factor = most_velocity / velocity;
    }
    if (turning * factor > most_turning) {
        factor = most_turning / turning;
    }
    return factor;
}

/// The law. It keeps nothing from step to step. Who: everybody. Blocks: no. Allocates: no.
inline Command control(const ServoSettings& settings, const View& present, const View& desired) noexcept {
    Command result;
    result.defect = defect(desired.seen, desired.depths);
    if (result.defect != Defect::none) {
        result.refusal = Refusal::desired;
        return result;
    }
    result.defect = defect(present.seen, present.depths);
    if (result.defect != Defect::none) {
        result.refusal = Refusal::seen;
        return result;
    }

    FeatureError error;
    for (std::size_t i = 0; i < points; ++i) {
        const auto row = static_cast<Eigen::Index>(2 * i);
        error[row] = present.seen[i].x - desired.seen[i].x;
        error[row + 1] = present.seen[i].y - desired.seen[i].y;
    }
    result.error = error.norm();

    InteractionMatrix matrix = InteractionMatrix::Zero();
    if (settings.interaction != Interaction::desired) {
        matrix += interaction_matrix(present.seen, present.depths);
    }
    if (settings.interaction != Interaction::current) {
        matrix += interaction_matrix(desired.seen, desired.depths);
    }
    if (settings.interaction == Interaction::mean) {
        matrix /= 2;
    }

    if (!matrix.allFinite() || !error.allFinite()) {
        result.refusal = Refusal::seen;
        result.defect = Defect::not_finite;
        return result;
    }
    // L^+ = (L^T L)^+ L^T, by the eigenvectors of L^T L, whose eigenvalues are the squared singular values.
    using Square = Eigen::Matrix<double, 6, 6>;
    const Eigen::SelfAdjointEigenSolver<Square> spectrum{Square{matrix.transpose() * matrix}};
    Twist components = spectrum.eigenvectors().transpose() * (matrix.transpose() * error);
    for (Eigen::Index i = 0; i < 6; ++i) {
        const double squared = std::max(0.0, spectrum.eigenvalues()[i]);
        const double damping = settings.damping * std::max(0.0, 1 - std::sqrt(squared) / settings.damp_below);
        const double divisor = squared + damping * damping;
        components[i] = divisor > 0 ? components[i] / divisor : 0;
    }
    const Twist way = spectrum.eigenvectors() * components;
    result.twist = -settings.gain(way.lpNorm<Eigen::Infinity>()) * way;
    if (!result.twist.allFinite()) {
        return {.error = result.error, .refusal = Refusal::seen, .defect = Defect::not_finite};
    }
    result.shortened = within(result.twist, settings.most_velocity, settings.most_turning);
    result.twist *= result.shortened;
    return result;
}

/// How deep the points lie if they lie on a plane that is seen as squarely as desired: the area of what is seen shrinks
/// with the square of the depth. Exact for a camera that looks along the plane's normal. Who: everybody. Allocates: no.
inline Depths depths_by_area(const ImagePoints& seen, const View& desired) noexcept {
    const double ratio = std::sqrt(area(desired.seen) / std::max(area(seen), 1e-12));
    Depths result = desired.depths;
    for (double& depth : result) {
        depth *= ratio;
    }
    return result;
}

}  // namespace groundstate::servo
