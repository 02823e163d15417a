// The watchdog: one budget for all waits of a cycle, whole grains, and what is counted.
#include "groundstate/watchdog.hpp"

#include <gtest/gtest.h>

namespace groundstate {
namespace {

TEST(Watchdog, AllWaitsOfACycleDrawOnOneBudget) {
    Watchdog watchdog{100};
    EXPECT_EQ(watchdog.left_ns(), 100);
    watchdog.waited(30);
    EXPECT_EQ(watchdog.left_ns(), 70);
    watchdog.waited(69);
    EXPECT_EQ(watchdog.left_ns(), 1);
    watchdog.waited(1);
    EXPECT_EQ(watchdog.left_ns(), 0);
    watchdog.waited(5);
    EXPECT_EQ(watchdog.left_ns(), 0) << "a wait may end late";
    EXPECT_EQ(watchdog.longest_wait_ns(), 105);
    EXPECT_EQ(watchdog.total_wait_ns(), 105);
    EXPECT_EQ(watchdog.budget_ns(), 100);
}

TEST(Watchdog, EachCycleHasTheWholeBudgetButForItsLateness) {
    Watchdog watchdog{100};
    watchdog.waited(60);
    watchdog.restart();
    EXPECT_EQ(watchdog.left_ns(), 100);
    watchdog.waited(20);
    watchdog.restart(30);
    EXPECT_EQ(watchdog.left_ns(), 70);
    watchdog.waited(40);
    EXPECT_EQ(watchdog.left_ns(), 30);
    EXPECT_EQ(watchdog.longest_wait_ns(), 60) << "of one cycle; lateness is no wait";
    EXPECT_EQ(watchdog.total_wait_ns(), 120);
    watchdog.restart(130);
    EXPECT_EQ(watchdog.left_ns(), 0);
    watchdog.waited(80);
    EXPECT_EQ(watchdog.longest_wait_ns(), 80) << "from nothing in each cycle";
}

TEST(Watchdog, AWaitTakesWholeGrains) {
    for (const std::int64_t grain_ns : {1, 2, 10}) {
        Watchdog watchdog{1'000, grain_ns};
        std::int64_t taken_ns = 0;
        for (std::int64_t span_ns = 0; span_ns <= 2 * grain_ns + 1; ++span_ns) {
            std::int64_t whole_ns = 0;
            while (whole_ns < span_ns) {
                whole_ns += grain_ns;
            }
            watchdog.waited(span_ns);
            taken_ns += whole_ns;
            EXPECT_EQ(watchdog.left_ns(), 1'000 - taken_ns) << span_ns << " by grains of " << grain_ns;
        }
        EXPECT_EQ(watchdog.total_wait_ns(), taken_ns);
    }
    Watchdog by_itself{10};
    by_itself.waited(1);
    EXPECT_EQ(by_itself.left_ns(), 9) << "without a model that is followed, nothing is rounded";
}

TEST(Watchdog, CountsWhatWasLeftOut) {
    Watchdog watchdog{0};
    EXPECT_EQ(watchdog.left_ns(), 0);
    watchdog.skip();
    watchdog.restart();
    watchdog.skip();
    EXPECT_EQ(watchdog.skipped(), 2) << "of all cycles";
    EXPECT_EQ(watchdog.longest_wait_ns(), 0);
}

}  // namespace
}  // namespace groundstate
