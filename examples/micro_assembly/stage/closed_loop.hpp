// The stage and the bench in one loop, for so long, in virtual or real time.
#pragma once

#include <groundstate/closed_loop/run.hpp>

#include "hooks.hpp"

namespace assembly_system {

/// A substrate that lies somewhere, by lot.
BenchSettings scattered(std::uint64_t seed);

struct LoopSettings {
    groundstate::closed_loop::RunSettings run{.span_ns = 4'000'000'000};
    BenchSettings bench{};
    ForceSettings force{};
    StageSettings stage{};
};

/// What a run came to.
struct Loop {
    Axes position{};
    BenchSettings bench{};
    double worst_force = 0;
    bool done = false;
    bool failed = false;  ///< the force was too large, and the stage has retracted
    std::vector<Stood> states{};
    std::vector<Felt> felt{};
    std::int64_t origin_ns = 0;
    groundstate::RunAccount account{};

    /// m and rad between part and substrate.
    double off() const { return std::hypot(position[0] - bench.x, position[1] - bench.y); }
    double turned() const { return std::abs(position[2] - bench.turn); }
    /// The part lies on the substrate, to a micrometre and 2 mrad, and was put there with less than 50 mN.
    bool assembled() const { return done && off() < 1e-6 && turned() < 2e-3 && worst_force < 0.05; }
};

/// Blocks: as long as the run takes. Allocates.
Loop run(const LoopSettings& settings);

}  // namespace assembly_system
