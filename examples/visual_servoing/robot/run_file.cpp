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

const char* text(ServoMode mode) {
    switch (mode) {
        case ServoMode::WITHOUT_TARGET: return "without target";
        case ServoMode::SEARCHING: return "searching";
        case ServoMode::TRACKING: return "tracking";
        case ServoMode::CONVERGED: return "converged";
        case ServoMode::COVERED: return "covered";
        case ServoMode::LOST: return "lost";
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
    json.key("title").text("Visual servoing on four points");
    json.key("note").text(
        "An arm of six joints with the camera in its hand, over a table with four discs. The operator sends two goals: views "
        "of the discs that the camera is to have.");
    closed_loop::write_disturbances(json, settings.disturbances);
    json.key("converged_below").number(Loop::converged_error);
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

void write_views(Json& json, const Loop& loop, const std::string& views) {
    json.key("views").open('[');
    int number = 0;
    for (const Kept& kept : loop.servoing->kept()) {
        if (kept.target == 0) {
            continue;
        }
        json.open('{');
        json.key("file").text(views + "/view-" + std::to_string(++number) + ".png");
        json.key("t_s").number(seconds(kept.captured_ns - loop.origin_ns));
        json.key("target").number(static_cast<double>(kept.target));
        json.close('}');
    }
    json.close(']');
}

void write_sights(Json& json, const Loop& loop) {
    const auto& sights = loop.servoing->sights();
    json.key("servoing").open('{');
    json.column("t_s", sights, [&](Json& j, const Sight& s) { j.number(seconds(s.at_ns - loop.origin_ns)); });
    json.column("image_age_ms", sights, [](Json& j, const Sight& s) { j.number(milliseconds(s.at_ns - s.captured_ns)); });
    json.column("target", sights, [](Json& j, const Sight& s) { j.number(static_cast<double>(s.target)); });
    json.column("track", sights, [](Json& j, const Sight& s) { j.text(text(s.tracked.track)); });
    json.column("mode", sights, [](Json& j, const Sight& s) { j.text(text(s.mode)); });
    json.column("error", sights, [](Json& j, const Sight& s) { s.tracked && s.command ? j.number(s.command.error) : j.nothing(); });
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

void write_results(Json& json, const LoopSettings& settings, const Loop& loop) {
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
    json.key("verdict").open('{');
    json.key("good").truth(loop.as_expected(settings));
    json.key("words").text(ending(loop));
    json.close('}');
}

}  // namespace

std::string ending(const Loop& loop) {
    char text[160];
    std::snprintf(text, sizeof text, "features %.1e, camera %.2f mm and %.3f degrees from the last goal: %s",
                  loop.feature_error, loop.position_error * 1e3, loop.turn_error * 180 / M_PI,
                  loop.converged() ? "converged"
                  : loop.holding   ? "holding, without set-points"
                                   : "not converged");
    return text;
}

void write_columns(Json& json, const LoopSettings& settings, const Loop& loop, const std::string& views) {
    write_scene(json, settings, loop);
    if (!views.empty()) {
        write_views(json, loop, views);
    }
    write_sights(json, loop);
    write_motions(json, loop);
    write_results(json, settings, loop);
}

}  // namespace controller_system
