// Builds arm, table and tasks, and runs them.
#include "closed_loop.hpp"

#include <algorithm>

namespace placing_system {

using namespace groundstate;

namespace {

std::vector<Place> scattered(int count, std::uint64_t seed) {
    plant::Random random{seed};
    std::vector<Place> parts;
    for (int i = 0; i < count; ++i) {
        const double x = 0.40 + 0.09 * i;
        parts.push_back({x + 0.02 * random.uniform(), -0.2 + 0.18 * random.uniform()});
    }
    return parts;
}

template <Clock C>
Loop run(const LoopSettings& settings, C& clock) {
    Loop loop;
    loop.origin_ns = clock.now_ns();
    loop.row.assign(example_row().begin(), example_row().begin() + settings.parts);
    const Now now = [&clock] { return clock.now_ns(); };
    Table table{scattered(settings.parts, settings.run.seed), settings.slip, settings.run.seed};
    TableCamera camera{now, table};
    PartFinder vision;
    PlacePlanner planner{now, loop.row};
    ToolMover robot{now, arm_with_tool()};
    JawController gripper{[&](bool closed) { return table.jaw(now(), closed); }};
    JointDrives motor{now, [&](std::int64_t at_ns, const Joints& velocity) { table.drive(at_ns, velocity); }};
    JointEncoders encoder{now, [&](std::int64_t at_ns) { return table.measured(at_ns); }};
    loop.account = closed_loop::run_tasks<System>(
        clock, Hooks{.camera = camera, .vision = vision, .planner = planner, .robot = robot, .gripper = gripper,
                     .motor = motor, .encoder = encoder},
        settings.run);
    loop.parts = table.parts();
    loop.sent = planner.sent();
    loop.placed = planner.placed();
    loop.missed = planner.missed();
    loop.slips = table.slips();
    return loop;
}

}  // namespace

const std::vector<Place>& example_row() {
    static const std::vector<Place> row{{0.42, 0.2}, {0.50, 0.2}, {0.58, 0.2}};
    return row;
}

double Loop::error(const Place& place) const {
    double nearest = INFINITY;
    for (const Place& part : parts) {
        nearest = std::min(nearest, std::hypot(part.x - place.x, part.y - place.y));
    }
    return nearest;
}

double Loop::worst() const {
    double result = 0;
    for (const Place& place : row) {
        result = std::max(result, error(place));
    }
    return result;
}

Loop run(const LoopSettings& settings) {
    return closed_loop::on_its_clock<System>(settings.run, [&](auto& clock) { return run(settings, clock); });
}

}  // namespace placing_system
