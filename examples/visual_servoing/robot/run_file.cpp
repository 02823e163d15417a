// A column for each quantity, and the results.
#include "run_file.hpp"

#include <groundstate/closed_loop/command_line.hpp>

namespace controller_system {

using namespace groundstate;
using closed_loop::Json;
using closed_loop::milliseconds;
using closed_loop::seconds;

namespace {

const char* text(vision::Track track) {
    switch (track) {
        case vision::Track::searching: return "searching";
        case vision::Track::tracking: return "tracking";
        case vision::Track::predicting: return "predicting";
    }
    return "";
}

std::array<double, 8> flat(const servo::Pixels& pixels) {
    std::array<double, 8> result{};
    for (std::size_t i = 0; i < servo::points; ++i) {
        result[2 * i] = pixels[i].u;
        result[2 * i + 1] = pixels[i].v;
    }
    return result;
}

void write_scene(Json& json, const LoopSettings& settings, const Loop& loop) {
    closed_loop::write_disturbances(json, settings.disturbances);
    json.key("image").numbers(std::array<double, 2>{640, 480});
    json.column("goals", loop.goals, [&](Json& j, const Goal& goal) {
        servo::Pixels pixels;
        const servo::View view = loop.cell->view(loop.cell->settings().target.pose * goal.camera);
        for (std::size_t i = 0; i < servo::points; ++i) {
            pixels[i] = loop.cell->settings().lens.pixel(view.seen[i]);
        }
        j.open('{');
        j.key("at_s").number(seconds(goal.at_ns));
        j.key("pixels").numbers(flat(pixels));
        j.close('}');
    });
}

void write_sights(Json& json, const Loop& loop) {
    const auto& sights = loop.servoing->sights();
    json.key("servoing").open('{');
    json.column("t_s", sights, [&](Json& j, const Sight& s) { j.number(seconds(s.at_ns - loop.origin_ns)); });
    json.column("image_age_ms", sights, [](Json& j, const Sight& s) { j.number(milliseconds(s.at_ns - s.captured_ns)); });
    json.column("target", sights, [](Json& j, const Sight& s) { j.number(static_cast<double>(s.target)); });
    json.column("track", sights, [](Json& j, const Sight& s) { j.text(text(s.tracked.track)); });
    json.column("error", sights, [](Json& j, const Sight& s) { s.command ? j.number(s.command.error) : j.nothing(); });
    json.column("pixels", sights, [](Json& j, const Sight& s) {
        s.tracked ? j.numbers(flat(s.tracked.pixels)) : j.nothing();
    });
    json.column("twist", sights, [](Json& j, const Sight& s) { j.numbers(s.command.twist); });
    json.close('}');
}

void write_motions(Json& json, const Loop& loop) {
    const auto& motions = loop.robot->motions();
    json.key("robot").open('{');
    json.column("t_s", motions, [&](Json& j, const Motion& m) { j.number(seconds(m.at_ns - loop.origin_ns)); });
    json.column("image_age_ms", motions, [](Json& j, const Motion& m) {
        m.captured_ns < 0 ? j.nothing() : j.number(milliseconds(m.at_ns - m.captured_ns));
    });
    json.column("holding", motions, [](Json& j, const Motion& m) { j.truth(m.holding); });
    json.column("set_point_rad", motions, [](Json& j, const Motion& m) { j.numbers(m.position); });
    json.column("set_velocity_rad_s", motions, [](Json& j, const Motion& m) { j.numbers(m.velocity); });
    json.column("measured_rad", motions, [](Json& j, const Motion& m) { j.numbers(m.measured); });
    json.close('}');

    const auto& drives = loop.motor->drives();
    json.key("motor").open('{');
    json.column("t_s", drives, [&](Json& j, const Drive& d) { j.number(seconds(d.at_ns - loop.origin_ns)); });
    json.column("image_age_ms", drives, [](Json& j, const Drive& d) {
        d.captured_ns < 0 ? j.nothing() : j.number(milliseconds(d.at_ns - d.captured_ns));
    });
    json.column("holding", drives, [](Json& j, const Drive& d) { j.truth(d.holding); });
    json.close('}');
}

void write_results(Json& json, const Loop& loop) {
    json.key("frames").open('{');
    json.key("delivered").number(static_cast<double>(loop.frames.delivered));
    json.key("lost").number(static_cast<double>(loop.frames.lost));
    json.key("timeouts").number(static_cast<double>(loop.frames.timeouts));
    json.close('}');
    json.key("end").open('{');
    json.key("feature_error").number(loop.feature_error);
    json.key("position_error_mm").number(loop.position_error * 1e3);
    json.key("turn_error_deg").number(loop.turn_error * 180 / M_PI);
    json.key("holding").truth(loop.holding);
    json.key("converged").truth(loop.converged());
    json.close('}');
}

}  // namespace

void write_columns(Json& json, const LoopSettings& settings, const Loop& loop) {
    write_scene(json, settings, loop);
    write_sights(json, loop);
    write_motions(json, loop);
    write_results(json, loop);
}

}  // namespace controller_system
