// The tracking head with its object in one loop, in virtual time.
#pragma once

#include <groundstate/simulated/camera.hpp>

#include "hooks.hpp"

namespace tracking_system {

struct LoopSettings {
    std::int64_t span_ns = 10'000'000'000;
    std::uint64_t seed = 1;
    groundstate::simulated::Faults faults{};
};

/// What a run came to.
struct Loop {
    std::vector<double> off_centre{};  ///< pixels, every 10 ms, as it really was
    std::vector<Sightings> shown{};
    long searches = 0;
    long unseen = 0;
    bool holding = false;  ///< at the end: there is nothing to follow

    /// The worst of the samples from one second on until the other.
    double worst(double from_s, double to_s) const;
};

/// In virtual time. Blocks: as long as it takes to compute. Allocates.
Loop run(const LoopSettings& settings);

}  // namespace tracking_system
