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
double within(const Twist& twist, double most_velocity, double most_turning) noexcept;

/// The law. It keeps nothing from step to step. Who: everybody. Blocks: no. Allocates: no.
Command control(const ServoSettings& settings, const View& present, const View& desired) noexcept;

/// How deep the points lie if they lie on a plane that is seen as squarely as desired: the area of what is seen shrinks
/// with the square of the depth. Exact for a camera that looks along the plane's normal. Who: everybody. Allocates: no.
Depths depths_by_area(const ImagePoints& seen, const View& desired) noexcept;

}  // namespace groundstate::servo
