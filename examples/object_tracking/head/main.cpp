// object_tracking: the head and the object before it for so long; what was seen as JSON.
// Exit status: 0 the object was kept in the middle, or the head stands as it must when the camera is gone; 1 it was not;
// 2 usage, or the world; 3 it was, but data were not valid or the log is not whole.
#include <algorithm>
#include <cstdio>

#include <groundstate/closed_loop/command_line.hpp>

#include "closed_loop.hpp"

using namespace tracking_system;
using groundstate::closed_loop::CommandLine;
using groundstate::closed_loop::Disturbances;
using groundstate::closed_loop::Json;

namespace {

void write_columns(Json& json, const Disturbances& wrong, const Loop& loop, double worst, bool tracked) {
    groundstate::closed_loop::write_disturbances(json, wrong);
    json.key("off_centre_px").numbers(loop.off_centre);
    json.key("sightings").open('{');
    json.column("t_s", loop.shown, [&](Json& j, const Sightings& s) {
        j.number(groundstate::closed_loop::seconds(s.captured_ns - loop.origin_ns));
    });
    json.column("off_centre_px", loop.shown, [](Json& j, const Sightings& s) { s.seen ? j.number(s.off_centre) : j.nothing(); });
    json.close('}');
    json.key("end").open('{');
    json.key("worst_off_centre_px").number(worst);
    json.key("searches").number(static_cast<double>(loop.searches));
    json.key("unseen").number(static_cast<double>(loop.unseen));
    json.key("holding").truth(loop.holding);
    json.key("tracked").truth(tracked);
    json.close('}');
}

}  // namespace

int main(int count, char** words) {
    LoopSettings settings;
    Disturbances wrong;
    CommandLine line{"object_tracking", "A camera on a head that follows an object, in closed loop", settings.run};
    line.disturbances(wrong);
    if (const auto status = line.read(count, words)) {
        return *status;
    }
    settings.faults = groundstate::closed_loop::faults(wrong, settings.run.seed, 100);
    const Loop loop = run(settings);
    tell(loop.account);

    // Once it has been found: from 1.5 s on, or from the middle of a shorter run.
    const double span_s = groundstate::closed_loop::seconds(settings.run.span_ns);
    const double from_s = std::min(1.5, span_s / 2);
    const double worst = loop.worst(from_s, span_s);
    const double bound = wrong.occlusion || wrong.slow ? 40 : 10;
    const bool tracked = !loop.off_centre.empty() && worst < bound && !loop.holding;
    std::printf("%zu sightings, %ld images without the object; searched whole %ld times\n", loop.shown.size(), loop.unseen,
                loop.searches);
    std::printf("from %.1f s on at most %.1f pixels from the middle (bound %.0f): %s\n", from_s, worst, bound,
                tracked ? "tracked" : loop.holding ? "holding, nothing to follow" : "not tracked");
    const bool at_rest = loop.holding && wrong.unplugged_s > 0;
    return line.end(loop.account, tracked || at_rest,
                    [&](Json& json) { write_columns(json, wrong, loop, worst, tracked); });
}
