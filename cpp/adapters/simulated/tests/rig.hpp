// The simulated camera as the conformance suite wants it: in virtual time, four discs before it.
#pragma once

#include "../../conformance/frame_source_suite.hpp"

#include "four_discs.hpp"

#include <groundstate/virtual_clock.hpp>

namespace groundstate::simulated {

template <PixelFormat Format, bool Spoiled>
struct Rig {
    using Source = Camera<VirtualClock>;
    static constexpr bool allocates = Spoiled;  // the blur does

    Opened<Source> open(const conformance::Script& script) {
        Settings settings{.shape = {320, 240, Format}, .readout_ns = script.late ? 5 * ms : ms};
        Faults& faults = settings.faults;
        (script.unplugged ? faults.unplug_after : faults.end_after) = script.frames;
        faults.lost = script.loses ? 0.3 : 0;
        faults.slow = script.loses ? 0.2 : 0;
        faults.slow_ns = 15 * ms;
        faults.damaged = script.damages ? 0.2 : 0;
        if (Spoiled) {
            faults.noise = 3;
            faults.blur = 0.8;
            faults.occluded = 0.1;
        }
        return Source::open(clock, four_discs(), [](std::int64_t) { return Pose{}; }, settings);
    }

    void pass() { clock.sleep_until_ns(clock.now_ns() + 3 * ms); }

    static constexpr std::int64_t ms = 1'000'000;
    VirtualClock clock{};
};

using Rigs = testing::Types<Rig<PixelFormat::mono8, false>, Rig<PixelFormat::bgr8, false>,
                            Rig<PixelFormat::mono8, true>, Rig<PixelFormat::rgb8, true>>;

}  // namespace groundstate::simulated
