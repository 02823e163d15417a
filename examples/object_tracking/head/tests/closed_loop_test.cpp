// The head finds the object, keeps it in the middle, and does so through noise, lost images and cover.
#include <gtest/gtest.h>

#include "closed_loop.hpp"

namespace tracking_system {
namespace {

TEST(Geometry, DirectionsAreSeenWhereTheyComeFrom) {
    const Angles head{0.3, -0.2};
    const Angles object = direction(head, {0.1, -0.15});
    EXPECT_LT(object[0], head[0]) << "to the right of the middle";
    EXPECT_GT(object[1], head[1]) << "above the middle";
    EXPECT_NEAR(seen_from(head, object).x, 0.1, 1e-12);
    EXPECT_NEAR(seen_from(head, object).y, -0.15, 1e-12);
}

TEST(Tracking, KeepsTheObjectInTheMiddle) {
    const Loop loop = run({});
    EXPECT_GT(loop.off_centre.front(), 50) << "it has something to do";
    EXPECT_LT(loop.worst(1.5, 10), 6);
    EXPECT_EQ(loop.searches, 1);
    EXPECT_FALSE(loop.holding);
    EXPECT_GT(loop.shown.size(), 900u);
    for (std::size_t i = 1; i < loop.shown.size(); ++i) {
        EXPECT_GT(loop.shown[i].captured_ns, loop.shown[i - 1].captured_ns);
    }
}

TEST(Tracking, IsTheSameForASeed) {
    const LoopSettings settings{.run = {.span_ns = 2'000'000'000, .seed = 5}, .faults = {.seed = 5, .lost = 0.1, .noise = 4}};
    EXPECT_EQ(run(settings).off_centre, run(settings).off_centre);
}

TEST(Tracking, GoesOnInNoiseAndThroughLostImages) {
    const Loop loop = run({.faults = {.seed = 2, .lost = 0.1, .noise = 5}});
    EXPECT_LT(loop.worst(1.5, 10), 10);
}

TEST(Tracking, LeadsOnWhileTheObjectIsCovered) {
    const Loop loop = run({.faults = {.seed = 3, .occluded = 0.01, .occluded_frames = 8}});
    EXPECT_GT(loop.unseen, 20);
    EXPECT_LT(loop.worst(1.5, 10), 40);
}

TEST(Tracking, StandsWhenThereIsNothingToFollow) {
    const Loop loop = run({.run = {.span_ns = 3'000'000'000}, .faults = {.unplug_after = 150}});
    EXPECT_TRUE(loop.holding);
    EXPECT_LT(loop.worst(1.2, 1.5), 10);
}

}  // namespace
}  // namespace tracking_system
