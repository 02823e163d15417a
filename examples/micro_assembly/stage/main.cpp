// micro_assembly: the stage and the bench for so long; force and height as JSON.
// Exit status: 0 the part lies on the substrate, or stands as it must when the microscope is gone; 1 it does not; 2 usage,
// or the world; 3 it does, but data were not valid or the log is not whole.
#include <cstdio>

#include <groundstate/closed_loop/command_line.hpp>

#include "closed_loop.hpp"

using namespace assembly_system;
using groundstate::closed_loop::CommandLine;
using groundstate::closed_loop::Json;

namespace {

const char* text(Progress state) {
    switch (state) {
        case Progress::PAUSED: return "wait";
        case Progress::ALIGNING:
        case Progress::ALIGNED: return "align";
        case Progress::LOWERING:
        case Progress::PLACED: return "lower";
        case Progress::RETRACTING:
        case Progress::RETRACTED: return "retract";
    }
    return "";
}

void write_columns(Json& json, const Loop& loop) {
    const auto since = [&](std::int64_t at_ns) { return groundstate::closed_loop::seconds(at_ns - loop.origin_ns); };
    json.key("stage").open('{');
    json.column("t_s", loop.states, [&](Json& j, const Stood& s) { j.number(since(s.at_ns)); });
    json.column("work", loop.states, [](Json& j, const Stood& s) { j.text(text(s.state)); });
    json.close('}');
    json.key("contact").open('{');
    json.column("t_s", loop.felt, [&](Json& j, const Felt& f) { j.number(since(f.at_ns)); });
    json.column("force_mN", loop.felt, [](Json& j, const Felt& f) { j.number(f.force * 1e3); });
    json.close('}');
    json.key("end").open('{');
    json.key("off_um").number(loop.off() * 1e6);
    json.key("turned_mrad").number(loop.turned() * 1e3);
    json.key("worst_force_mN").number(loop.worst_force * 1e3);
    json.key("done").truth(loop.done);
    json.key("assembled").truth(loop.assembled());
    json.close('}');
}

}  // namespace

int main(int count, char** words) {
    LoopSettings settings;
    bool noise = false;
    double unplugged_s = 0;
    CommandLine line{"micro_assembly", "A part put onto a substrate under a microscope, in closed loop", settings.run};
    line.flag("--noise", noise, "images with noise");
    line.seconds("--unplugged", unplugged_s, "the microscope is gone from then on");
    if (const auto status = line.read(count, words)) {
        return *status;
    }
    settings.bench = scattered(settings.run.seed);
    settings.bench.noise = noise ? 4 : 0;
    settings.bench.unplugged_s = unplugged_s;
    const Loop loop = run(settings);
    tell(loop.account);
    const bool stands = unplugged_s > 0 && !loop.done && loop.worst_force == 0;
    std::printf("%.2f um and %.2f mrad from the substrate, at most %.1f mN: %s\n", loop.off() * 1e6, loop.turned() * 1e3,
                loop.worst_force * 1e3,
                loop.assembled() ? "assembled"
                : loop.failed    ? "retracted, the force was too large"
                : stands         ? "standing, without images"
                                 : "not assembled");
    return line.end(loop.account, loop.assembled() || stands, [&](Json& json) { write_columns(json, loop); });
}
