// The arm and the table in one loop, for so long, in virtual or real time.
//
// In: how many parts lie about, how often the jaw slips, the seed of both. Out: where the parts lie in the end.
#pragma once

#include <groundstate/closed_loop/run.hpp>

#include "hooks.hpp"

namespace placing_system {

/// Where parts are to be put, in this order.
const std::vector<Place>& example_row();

struct LoopSettings {
    groundstate::closed_loop::RunSettings run{.span_ns = 35'000'000'000};
    double slip = 0;  ///< the share of grips that push the part aside
    int parts = 3;    ///< as many places of the row are filled
};

/// What a run came to.
struct Loop {
    std::vector<Place> row{};
    std::vector<Place> parts{};
    std::vector<Sent> sent{};
    std::size_t placed = 0;
    long missed = 0;
    long slips = 0;
    std::int64_t origin_ns = 0;
    groundstate::RunAccount account{};

    /// m, from the place of the row to the part that is nearest.
    double error(const Place& place) const;
    double worst() const;
    /// All are where they are to be, to 2 mm.
    bool in_a_row() const { return placed == row.size() && worst() < 2e-3; }
};

/// Blocks: as long as the run takes. Allocates.
Loop run(const LoopSettings& settings);

}  // namespace placing_system
