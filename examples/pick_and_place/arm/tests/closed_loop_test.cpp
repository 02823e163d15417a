// Parts that lie about are put in a row, also if the jaw slips.
#include <gtest/gtest.h>

#include "hooks.hpp"

namespace placing_system {
namespace {

const std::vector<Place> row{{0.42, 0.2}, {0.50, 0.2}, {0.58, 0.2}};

struct Placed {
    std::vector<Place> parts;
    std::size_t placed = 0;
    long missed = 0;
    long slips = 0;
};

Placed run(std::uint64_t seed, double slip, std::int64_t span_ns) {
    groundstate::VirtualClock clock{System<groundstate::VirtualClock>::threads};
    const Now now = [&clock] { return clock.now_ns(); };
    groundstate::plant::Random random{seed};
    std::vector<Place> parts;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const double x = 0.40 + 0.09 * static_cast<double>(i);
        parts.push_back({x + 0.02 * random.uniform(), -0.2 + 0.18 * random.uniform()});
    }
    Table table{parts, slip, seed};
    TableCamera camera{now, table};
    PartFinder vision;
    PlacePlanner planner{row};
    ToolMover robot{now, arm_with_tool()};
    JawController gripper{[&](bool closed) { return table.jaw(now(), closed); }};
    JointDrives motor{now, [&](std::int64_t at_ns, const Joints& velocity) { table.drive(at_ns, velocity); }};
    JointEncoders encoder{now, [&](std::int64_t at_ns) { return table.measured(at_ns); }};
    auto system = std::make_unique<System<groundstate::VirtualClock>>(
        clock, Hooks{.camera = camera, .vision = vision, .planner = planner, .robot = robot, .gripper = gripper,
                     .motor = motor, .encoder = encoder},
        groundstate::Options{});
    EXPECT_TRUE(system->run(span_ns));
    return {table.parts(), planner.placed(), planner.missed(), table.slips()};
}

void expect_in_a_row(const Placed& end) {
    EXPECT_EQ(end.placed, row.size());
    for (const Place& place : row) {
        double nearest = INFINITY;
        for (const Place& part : end.parts) {
            nearest = std::min(nearest, std::hypot(part.x - place.x, part.y - place.y));
        }
        EXPECT_LT(nearest * 1e3, 2) << "mm from " << place.x << ", " << place.y;
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
    const Placed result = run(1, 0, 35 * second);
    expect_in_a_row(result);
    EXPECT_EQ(result.missed, 0);
}

TEST(Placing, TriesAgainWhenTheJawSlips) {
    const Placed result = run(4, 0.4, 40 * second);
    expect_in_a_row(result);
    EXPECT_GT(result.slips, 0);
    EXPECT_EQ(result.missed, result.slips);
}

TEST(Placing, IsTheSameForASeed) {
    const Placed one = run(5, 0.4, 4 * second);
    const Placed other = run(5, 0.4, 4 * second);
    for (std::size_t i = 0; i < one.parts.size(); ++i) {
        EXPECT_EQ(one.parts[i].x, other.parts[i].x);
        EXPECT_EQ(one.parts[i].y, other.parts[i].y);
    }
}

}  // namespace
}  // namespace placing_system
