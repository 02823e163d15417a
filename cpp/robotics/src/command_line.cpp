// Options by CLI11, messages of our own; the file of a run.
#include <groundstate/closed_loop/command_line.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <CLI/CLI.hpp>

namespace groundstate::closed_loop {

namespace {

constexpr int good = 0;
constexpr int bad = 1;
constexpr int unusable = 2;
constexpr int incomplete = 3;

// A time above 0 and up to an hour, in seconds; below 0 if it is none.
double seconds_of(const std::string& text) {
    char* rest = nullptr;
    const double value = std::strtod(text.c_str(), &rest);
    const double unit = std::strcmp(rest, "ms") == 0 ? 1e-3 : *rest == '\0' || std::strcmp(rest, "s") == 0 ? 1 : 0;
    const double result = value * unit;
    return rest != text.c_str() && result > 0 && result <= 3600 ? result : -1;
}

CLI::Validator time() {
    return {[](const std::string& text) {
                return seconds_of(text) > 0 ? std::string{} : "'" + text + "' is no time above 0 and up to an hour, as 10s, 0.5s, 20ms";
            },
            ""};
}

// Without a sign, which strtoull would take.
CLI::Validator whole_number() {
    return {[](const std::string& text) {
                const bool is_one = !text.empty() && text.size() <= 19 &&
                                    text.find_first_not_of("0123456789") == std::string::npos;
                return is_one ? std::string{} : "'" + text + "' is no whole number from 0 on, of 19 digits at most";
            },
            ""};
}

}  // namespace

struct CommandLine::Options {
    Options(const char* program, const char* what) : app{what, program} {}
    CLI::App app;
};

CommandLine::CommandLine(const char* program, const char* what, RunSettings& settings)
    : program_{program}, settings_{settings}, options_{std::make_unique<Options>(program, what)} {
    CLI::App& app = options_->app;
    const auto for_so_long = [&](const char* name, bool is_real, const char* how) {
        return app
            .add_option_function<std::string>(
                name,
                [this, is_real](const std::string& text) {
                    settings_.is_real = is_real;
                    settings_.span_ns = static_cast<std::int64_t>(seconds_of(text) * 1e9);
                },
                how)
            ->type_name("TIME")
            ->check(time());
    };
    CLI::Option* simulated = for_so_long("--virtual", false, "run so long in virtual time: the same each time");
    CLI::Option* real = for_so_long("--real", true, "run so long in real time");
    simulated->excludes(real);
    app.add_flag("--uneven", settings_.is_uneven, "in virtual time phases last as it happens, now and then too long")->excludes(real);
    app.add_option_function<std::string>(
           "--seed", [this](const std::string& text) { settings_.seed = std::strtoull(text.c_str(), nullptr, 10); },
           "of everything that is left to chance")
        ->type_name("NUMBER")
        ->check(whole_number());
    app.add_option("--realtime", settings_.priority, "SCHED_FIFO from this priority on")->check(CLI::Range(1, 90))->needs(real);
    seconds("--patience", settings_.patience_s, "a task that makes no progress for so long hangs (virtual time: 10s, real: 0.5s)");
#ifdef GROUNDSTATE_SEEDED_FAULTS
    app.add_option_function<int>(
           "--seed-fault", [](int number) { seeded_fault = static_cast<Fault>(number); }, "what the runtime does wrong")
        ->check(CLI::Range(0, 4));
#endif
    app.add_option("--log", settings_.log, "write the tasks' events to this file, as MCAP")->type_name("FILE");
    app.add_option("--run", run_file_, "write what was recorded to this file, as JSON")->type_name("FILE");
}

CommandLine::~CommandLine() = default;

void CommandLine::flag(const char* name, bool& value, const char* what) { options_->app.add_flag(name, value, what); }

void CommandLine::seconds(const char* name, double& value, const char* what) {
    options_->app
        .add_option_function<std::string>(name, [&value](const std::string& text) { value = seconds_of(text); }, what)
        ->type_name("TIME")
        ->check(time());
}

void CommandLine::share(const char* name, double& value, const char* what) {
    options_->app.add_option(name, value, what)->check(CLI::Range(0.0, 1.0));
}

void CommandLine::number(const char* name, int& value, int least, int most, const char* what) {
    options_->app.add_option(name, value, what)->check(CLI::Range(least, most));
}

void CommandLine::choice(const char* name, int& value, const std::vector<std::string>& names, const char* what) {
    options_->app
        .add_option_function<std::string>(
            name,
            [&value, names](const std::string& text) {
                value = static_cast<int>(std::find(names.begin(), names.end(), text) - names.begin());
            },
            what)
        ->type_name("")
        ->check(CLI::IsMember(names));
}

void CommandLine::folder(const char* name, std::string& value, const char* what) {
    options_->app.add_option(name, value, what)->check(CLI::ExistingDirectory)->type_name("FOLDER");
}

void CommandLine::disturbances(Disturbances& wrong) {
    flag("--noise", wrong.noise, "images with noise");
    flag("--dropped", wrong.dropped, "every tenth image is lost");
    flag("--slow", wrong.slow, "every fifth image is 15 ms late");
    flag("--occlusion", wrong.occlusion, "something covers a disc now and then");
    seconds("--unplugged", wrong.unplugged_s, "the camera is gone from then on");
}

void CommandLine::complain(const std::string& what) const {
    std::fprintf(stderr, "%s: %s\n", program_, what.c_str());
}

std::optional<int> CommandLine::read(int count, char** words) {
    try {
        options_->app.parse(count, words);
    } catch (const CLI::CallForHelp&) {
        std::fputs(options_->app.help().c_str(), stdout);
        return good;
    } catch (const CLI::ParseError& error) {
        complain(error.what());
        std::fprintf(stderr, "%s --help tells what there is\n", program_);
        return unusable;
    }
    for (const std::string& file : {settings_.log, run_file_}) {
        if (const int error = McapFile::probe(file); error != 0) {
            complain(file + " cannot be written: " + std::strerror(error));
            return unusable;
        }
    }
    return std::nullopt;
}

std::string CommandLine::from_run_file(const std::string& path) const {
    namespace fs = std::filesystem;
    if (path.empty()) {
        return path;
    }
    return fs::absolute(path).lexically_normal().lexically_proximate(fs::absolute(run_file_).lexically_normal().parent_path()).string();
}

int CommandLine::end(const RunAccount& account, bool is_good, const std::function<void(Json&)>& columns) {
    if (!run_file_.empty()) {
        std::FILE* file = std::fopen(run_file_.c_str(), "w");
        int error = file != nullptr ? 0 : errno;
        if (file != nullptr) {
            Json json{file};
            json.open('{');
            write_settings(json, settings_);
            if (!settings_.log.empty()) {
                json.key("log").text(from_run_file(settings_.log));
            }
            columns(json);
            write_tasks(json, account);
            json.close('}');
            std::fputc('\n', file);
            error = json.is_written() ? 0 : errno;
            error = std::fclose(file) == 0 || error != 0 ? error : errno;
        }
        if (error != 0) {
            complain(run_file_ + " cannot be written: " + std::strerror(error));
            return unusable;
        }
    }
    if (!is_good || !account.ending) {
        return bad;
    }
    return is_complete(account) ? good : incomplete;
}

void write_settings(Json& json, const RunSettings& settings) {
    json.key("time").text(settings.is_real ? "real" : "virtual");
    json.key("span_s").number(closed_loop::seconds(settings.span_ns));
    json.key("seed").number(static_cast<double>(settings.seed));
}

void write_disturbances(Json& json, const Disturbances& wrong) {
    json.key("disturbances").open('{');
    json.key("noise").truth(wrong.noise);
    json.key("dropped").truth(wrong.dropped);
    json.key("slow").truth(wrong.slow);
    json.key("occlusion").truth(wrong.occlusion);
    json.key("unplugged_s").number(wrong.unplugged_s);
    json.close('}');
}

void write_tasks(Json& json, const RunAccount& account) {
    json.column("tasks", account.tasks, [](Json& j, const TaskAccount& task) {
        j.open('{');
        j.key("name").text(task.name);
        j.key("cycles").number(static_cast<double>(task.cycles));
        j.key("deadlines_missed").number(static_cast<double>(task.deadlines_missed));
        j.key("skipped").number(static_cast<double>(task.skipped));
        j.key("invalid").number(static_cast<double>(task.invalid));
        j.key("worst_lateness_us").number(static_cast<double>(task.worst_lateness_ns) * 1e-3);
        j.key("worst_duration_us").number(static_cast<double>(task.worst_duration_ns) * 1e-3);
        j.close('}');
    });
}

}  // namespace groundstate::closed_loop
