// Parts are put onto their substrates to less than a micrometre, gently; and nothing is crushed when something fails.
#include <gtest/gtest.h>

#include "hooks.hpp"

namespace assembly_system {
namespace {

struct Assembled {
    Axes position{};
    double worst_force = 0;
    bool done = false;
    bool failed = false;
    Work work = Work::wait;
};

Assembled run(const BenchSettings& settings, const StageSettings& stage_settings = {}, std::int64_t span_ns = 4'000'000'000) {
    groundstate::VirtualClock clock{System<groundstate::VirtualClock>::threads};
    const Now now = [&clock] { return clock.now_ns(); };
    Bench bench{settings};
    MicroscopeImages microscope{now, bench};
    MarkAligner aligner;
    ForceSensor force{now, bench};
    StageMover stage{now, stage_settings};
    PiezoAxes piezo{now, bench};
    LinearScales scales{now, bench};
    AssemblySupervisor supervisor;
    auto system = std::make_unique<System<groundstate::VirtualClock>>(
        clock, Hooks{.microscope = microscope, .aligner = aligner, .force = force, .stage = stage, .piezo = piezo,
                     .scales_reader = scales, .supervisor = supervisor},
        groundstate::Options{});
    EXPECT_TRUE(system->run(span_ns));
    return {bench.position(span_ns), bench.worst_force(), supervisor.is_done(), supervisor.failed(), supervisor.work()};
}

double off(const Assembled& end, const BenchSettings& settings) {
    return std::hypot(end.position[0] - settings.x, end.position[1] - settings.y);
}

TEST(Assembly, PutsThePartOntoTheSubstrate) {
    groundstate::plant::Random random{1};
    for (int trial = 0; trial < 3; ++trial) {
        const BenchSettings settings{.x = 8e-5 * random.normal(),
                                     .y = 8e-5 * random.normal(),
                                     .turn = 0.1 * random.normal(),
                                     .contact_z = 2e-4 + 1e-4 * random.uniform(),
                                     .noise = trial % 2 == 0 ? 0.0 : 4.0,
                                     .seed = random.bits()};
        SCOPED_TRACE(trial);
        const Assembled result = run(settings);
        EXPECT_TRUE(result.done);
        EXPECT_LT(off(result, settings) * 1e6, 1) << "micrometres";
        EXPECT_LT(std::abs(result.position[2] - settings.turn), 2e-3);
        EXPECT_GT(result.position[3], settings.contact_z);
        EXPECT_LT(result.worst_force, 0.05);
    }
}

TEST(Assembly, IsTheSameForASeed) {
    const BenchSettings settings{.x = 5e-5, .y = -3e-5, .turn = 0.05, .noise = 4, .seed = 9};
    EXPECT_EQ(run(settings).position, run(settings).position);
}

// The sensor's threshold is above the bound: the bound alone is left.
TEST(Assembly, RetractsWhenTheForceIsTooLarge) {
    const BenchSettings settings{.x = 5e-5, .y = -3e-5, .turn = 0.05};
    const Assembled result = run(settings, {.contact = 1.0, .most_force = 0.06});
    EXPECT_TRUE(result.failed);
    EXPECT_LT(result.worst_force, 0.08);
    EXPECT_LT(result.position[3], 1e-6);
}

TEST(Assembly, StandsWhenTheMicroscopeIsGone) {
    const BenchSettings settings{.x = 5e-5, .y = -3e-5, .turn = 0.05, .unplugged_s = 0.1};
    const Assembled result = run(settings, {}, 3'000'000'000);
    EXPECT_FALSE(result.done);
    EXPECT_LT(result.position[3], settings.contact_z);
    EXPECT_EQ(result.worst_force, 0);
}

}  // namespace
}  // namespace assembly_system
