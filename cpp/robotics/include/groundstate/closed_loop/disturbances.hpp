// What goes wrong with the images of a run, as the programs' command lines name it, and as the simulated camera has it.
#pragma once

#include <cstdint>

#include <groundstate/simulated/exposures.hpp>

namespace groundstate::closed_loop {

/// All is off at first.
struct Disturbances {
    bool noise = false;      ///< of the image: 5 of 255 steps
    bool dropped = false;    ///< every tenth image is lost
    bool slow = false;       ///< every fifth image arrives 15 ms late
    bool occlusion = false;  ///< every hundredth image something covers a disc, for 6 images
    double unplugged_s = 0;  ///< when the camera is gone for good; 0: never
};

/// The same, for a camera of so many images a second.
inline simulated::Faults faults(const Disturbances& wrong, std::uint64_t seed, double images_a_second) {
    simulated::Faults result{.seed = seed};
    result.noise = wrong.noise ? 5 : 0;
    result.lost = wrong.dropped ? 0.1 : 0;
    result.slow = wrong.slow ? 0.2 : 0;
    result.slow_ns = wrong.slow ? 15'000'000 : 0;
    result.occluded = wrong.occlusion ? 0.01 : 0;
    result.occluded_frames = 6;
    result.unplug_after = static_cast<std::uint64_t>(wrong.unplugged_s * images_a_second);
    return result;
}

}  // namespace groundstate::closed_loop
