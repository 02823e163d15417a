// Builds bench, stage and tasks, and runs them.
#include "closed_loop.hpp"

namespace assembly_system {

using namespace groundstate;

namespace {

template <Clock C>
Loop run(const LoopSettings& settings, C& clock) {
    Loop loop;
    loop.origin_ns = clock.now_ns();
    loop.bench = settings.bench;
    const Now now = [&clock] { return clock.now_ns(); };
    Bench bench{settings.bench, loop.origin_ns};
    MicroscopeImages microscope{now, bench};
    MarkAligner aligner;
    ForceSensor force{now, bench, settings.force, static_cast<std::size_t>(settings.run.span_ns / 1'000'000 + 10)};
    StageMover stage{now, settings.stage, static_cast<std::size_t>(settings.run.span_ns / 2'000'000 + 10)};
    PiezoAxes piezo{now, bench};
    LinearScales scales{now, bench};
    AssemblySupervisor supervisor;
    loop.account = closed_loop::run_tasks<System>(
        clock, Hooks{.microscope = microscope, .aligner = aligner, .force = force, .stage = stage, .piezo = piezo,
                     .scales_reader = scales, .supervisor = supervisor},
        settings.run);
    loop.position = bench.position(loop.origin_ns + settings.run.span_ns);
    loop.worst_force = bench.worst_force();
    loop.done = supervisor.is_done();
    loop.failed = supervisor.failed();
    loop.states = stage.states();
    loop.felt = force.felt();
    return loop;
}

}  // namespace

BenchSettings scattered(std::uint64_t seed) {
    plant::Random random{seed};
    BenchSettings result;
    result.x = 8e-5 * random.normal();
    result.y = 8e-5 * random.normal();
    result.turn = 0.1 * random.normal();
    result.contact_z = 2e-4 + 1e-4 * random.uniform();
    result.seed = random.bits();
    return result;
}

Loop run(const LoopSettings& settings) {
    return closed_loop::on_its_clock<System>(settings.run, [&](auto& clock) { return run(settings, clock); });
}

}  // namespace assembly_system
