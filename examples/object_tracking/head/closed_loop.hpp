// The tracking head with its object in one loop, for so long, in virtual or real time.
#pragma once

#include <groundstate/closed_loop/disturbances.hpp>
#include <groundstate/closed_loop/run.hpp>
#include <groundstate/simulated/camera.hpp>

#include "hooks.hpp"

namespace tracking_system {

struct LoopSettings {
    groundstate::closed_loop::RunSettings run{};
    groundstate::simulated::Faults faults{};
};

/// What a run came to.
struct Loop {
    std::vector<double> off_centre{};  ///< pixels, every 10 ms, as it really was
    std::vector<Sightings> shown{};
    long searches = 0;
    long unseen = 0;
    bool holding = false;  ///< at the end: there is nothing to follow
    std::int64_t origin_ns = 0;
    groundstate::RunAccount account{};

    /// The worst of the samples from one second on until the other; 0 where there are none.
    double worst(double from_s, double to_s) const;
};

/// Blocks: as long as the run takes. Allocates.
Loop run(const LoopSettings& settings);

}  // namespace tracking_system
