// A generated system with a simulated world around it, in one loop, for so long, in virtual or real time.
//
// The clock is chosen here; whoever builds the world and the hooks does so with that clock. INVARIANT: in virtual time a
// run depends on its settings alone.
#pragma once

#include <memory>
#include <string>
#include <type_traits>

#include <groundstate/program.hpp>

namespace groundstate::closed_loop {

/// How a loop is run.
struct RunSettings {
    std::int64_t span_ns = 10'000'000'000;
    bool is_real = false;
    bool is_uneven = false;  ///< in virtual time phases last as it happens, now and then too long
    std::uint64_t seed = 1;  ///< of the world, and of what is uneven
    int priority = 0;        ///< of SCHED_FIFO for the least urgent task, in real time; 0 asks for nothing
    double patience_s = 0;   ///< so long a task may make no progress (system.hpp); 0: as usual
    std::string log{};       ///< the file for the events, as MCAP; none if empty
};

/// Calls `run` with the clock that the settings ask for; virtual time waits until all tasks of the system have started.
template <template <class> class System, class Run>
auto on_its_clock(const RunSettings& settings, Run&& run) {
    if (settings.is_real) {
        MonotonicClock clock;
        return run(clock);
    }
    VirtualClock clock{System<VirtualClock>::threads};
    return run(clock);
}

/// Runs the tasks on this clock. Blocks: as long as the run takes. Allocates. A task that hangs ends the program
/// (`run_to_account`).
template <template <class> class System, Clock C, class Hooks>
RunAccount run_tasks(C& clock, const Hooks& hooks, const RunSettings& settings) {
    Options options;
    options.log = settings.log;
    if (settings.patience_s > 0) {
        options.patience_ns = options.guard_ns = static_cast<std::int64_t>(settings.patience_s * 1e9);
    }
    if constexpr (std::is_same_v<C, MonotonicClock>) {
        options.priority = settings.priority;
        if (settings.priority > 0) {
            lock_memory();
        }
    } else if (settings.is_uneven) {
        options.pacing = {.pace = Pace::drawn, .tick_ns = 1, .seed = settings.seed, .overrun = 8};
    }
    const auto system = std::make_unique<System<C>>(clock, hooks, options);
    return run_to_account(*system, settings.span_ns);
}

}  // namespace groundstate::closed_loop
