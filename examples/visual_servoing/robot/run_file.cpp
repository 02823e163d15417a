// The JSON of a run: settings, a column for each quantity, results.
#include "run_file.hpp"

#include <charconv>
#include <string_view>

namespace controller_system {

using namespace groundstate;

namespace {

// Objects and arrays with their commas.
class Json {
  public:
    explicit Json(std::FILE* file) : file_{file} {}

    Json& key(std::string_view name) {
        separate();
        std::fprintf(file_, "\n\"%.*s\":", static_cast<int>(name.size()), name.data());
        first_ = true;
        return *this;
    }
    void open(char bracket) {
        separate();
        std::fputc(bracket, file_);
        first_ = true;
    }
    void close(char bracket) {
        std::fputc(bracket, file_);
        first_ = false;
    }
    void number(double value) {
        separate();
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, value).ptr;
        std::fwrite(std::isfinite(value) ? text : "null", 1, std::isfinite(value) ? static_cast<std::size_t>(end - text) : 4, file_);
    }
    void nothing() {
        separate();
        std::fputs("null", file_);
    }
    void truth(bool value) {
        separate();
        std::fputs(value ? "true" : "false", file_);
    }
    void text(std::string_view value) {
        separate();
        std::fprintf(file_, "\"%.*s\"", static_cast<int>(value.size()), value.data());
    }
    template <class Values>
    void numbers(const Values& values) {
        open('[');
        for (const double value : values) {
            number(value);
        }
        close(']');
    }

    /// An array of what a function gives of each entry.
    template <class Entries, class Of>
    void column(std::string_view name, const Entries& entries, const Of& of) {
        key(name).open('[');
        for (const auto& entry : entries) {
            of(*this, entry);
        }
        close(']');
    }

  private:
    void separate() {
        if (!first_) {
            std::fputc(',', file_);
        }
        first_ = false;
    }

    std::FILE* file_;
    bool first_ = true;
};

double seconds(std::int64_t span_ns) { return static_cast<double>(span_ns) * 1e-9; }
double milliseconds(std::int64_t span_ns) { return static_cast<double>(span_ns) * 1e-6; }

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

void write_settings(Json& json, const LoopSettings& settings, const Loop& loop) {
    const Disturbances& wrong = settings.disturbances;
    json.key("time").text(settings.is_real ? "real" : "virtual");
    json.key("span_s").number(seconds(settings.span_ns));
    json.key("seed").number(static_cast<double>(settings.seed));
    json.key("disturbances").open('{');
    json.key("noise").truth(wrong.noise);
    json.key("dropped").truth(wrong.dropped);
    json.key("slow").truth(wrong.slow);
    json.key("occlusion").truth(wrong.occlusion);
    json.key("unplugged_s").number(wrong.unplugged_s);
    json.close('}');
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
    json.column("tasks", loop.tasks, [](Json& j, const TaskAccount& task) {
        j.open('{');
        j.key("name").text(task.name);
        j.key("cycles").number(static_cast<double>(task.cycles));
        j.key("deadlines_missed").number(static_cast<double>(task.deadlines_missed));
        j.key("worst_lateness_us").number(static_cast<double>(task.worst_lateness_ns) * 1e-3);
        j.key("worst_duration_us").number(static_cast<double>(task.worst_duration_ns) * 1e-3);
        j.close('}');
    });
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

bool write_run(std::FILE* file, const LoopSettings& settings, const Loop& loop) {
    Json json{file};
    json.open('{');
    write_settings(json, settings, loop);
    write_sights(json, loop);
    write_motions(json, loop);
    write_results(json, loop);
    json.close('}');
    std::fputc('\n', file);
    return std::fflush(file) == 0 && std::ferror(file) == 0;
}

}  // namespace controller_system
