// Parts are put onto their substrates to less than a micrometre, gently; and nothing is crushed when something fails.
#include <gtest/gtest.h>

#include "closed_loop.hpp"

namespace assembly_system {
namespace {

TEST(Assembly, PutsThePartOntoTheSubstrate) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        LoopSettings settings{.run = {.span_ns = 2'500'000'000}, .bench = scattered(seed)};
        settings.bench.noise = seed % 2 == 0 ? 0.0 : 4.0;
        SCOPED_TRACE(seed);
        const Loop result = run(settings);
        EXPECT_TRUE(result.account.ending);
        EXPECT_TRUE(result.done);
        EXPECT_LT(result.off() * 1e6, 1) << "micrometres";
        EXPECT_LT(result.turned(), 2e-3);
        EXPECT_GT(result.position[3], settings.bench.contact_z);
        EXPECT_LT(result.worst_force, 0.05);
    }
}

TEST(Assembly, IsTheSameForASeed) {
    const LoopSettings settings{.run = {.span_ns = 1'000'000'000},
                                .bench = {.x = 5e-5, .y = -3e-5, .turn = 0.05, .noise = 4, .seed = 9}};
    EXPECT_EQ(run(settings).position, run(settings).position);
}

// The sensor's threshold is above the bound: the bound alone is left.
TEST(Assembly, RetractsWhenTheForceIsTooLarge) {
    const Loop result = run({.bench = {.x = 5e-5, .y = -3e-5, .turn = 0.05}, .force = {.contact = 1.0, .most = 0.06}});
    EXPECT_TRUE(result.failed);
    EXPECT_LT(result.worst_force, 0.08);
    EXPECT_LT(result.position[3], 1e-6);
}

TEST(Assembly, StandsWhenTheMicroscopeIsGone) {
    const Loop result = run({.run = {.span_ns = 2'000'000'000}, .bench = {.x = 5e-5, .y = -3e-5, .turn = 0.05, .unplugged_s = 0.1}});
    EXPECT_FALSE(result.done);
    EXPECT_LT(result.position[3], result.bench.contact_z);
    EXPECT_EQ(result.worst_force, 0);
}

}  // namespace
}  // namespace assembly_system
