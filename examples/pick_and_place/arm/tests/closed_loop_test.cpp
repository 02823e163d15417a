// Parts that lie about are put in a row, also if the jaw slips.
#include <gtest/gtest.h>

#include "closed_loop.hpp"

namespace placing_system {
namespace {

void expect_in_a_row(const Loop& end) {
    EXPECT_TRUE(end.account.ending);
    EXPECT_EQ(end.placed, end.row.size());
    for (const Place& place : end.row) {
        EXPECT_LT(end.error(place) * 1e3, 2) << "mm from " << place.x << ", " << place.y;
    }
}

constexpr std::int64_t second = 1'000'000'000;

TEST(Geometry, TheCameraSeesTheTableWhereItIs) {
    const Eigen::Vector3d point{0.45, -0.13, 0};
    const Eigen::Vector3d seen = camera_above().inverse() * point;
    const Place place = on_table(lens.pixel({seen.x() / seen.z(), seen.y() / seen.z()}));
    EXPECT_NEAR(place.x, point.x(), 1e-12);
    EXPECT_NEAR(place.y, point.y(), 1e-12);
    EXPECT_NEAR(camera_above().linear().determinant(), 1, 1e-12);
}

TEST(Placing, PutsTheParts) {
    const Loop result = run({.run = {.span_ns = 35 * second, .seed = 1}});
    expect_in_a_row(result);
    EXPECT_EQ(result.missed, 0);
}

TEST(Placing, TriesAgainWhenTheJawSlips) {
    const Loop result = run({.run = {.span_ns = 20 * second, .seed = 6}, .slip = 0.5, .parts = 1});
    expect_in_a_row(result);
    EXPECT_EQ(result.slips, 2);
    EXPECT_EQ(result.missed, result.slips);
}

TEST(Placing, IsTheSameForASeed) {
    const LoopSettings settings{.run = {.span_ns = 4 * second, .seed = 5}, .slip = 0.4};
    const Loop one = run(settings);
    const Loop other = run(settings);
    for (std::size_t i = 0; i < one.parts.size(); ++i) {
        EXPECT_EQ(one.parts[i].x, other.parts[i].x);
        EXPECT_EQ(one.parts[i].y, other.parts[i].y);
    }
}

}  // namespace
}  // namespace placing_system
