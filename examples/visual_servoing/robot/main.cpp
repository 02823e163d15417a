// visual_servoing: the controller and the simulated cell for so long; what happened as JSON, what was seen as PNG.
// Exit status: 0 it converged, or came to rest as it must when the camera is gone; 1 it did not; 2 usage, or the world.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "pictures.hpp"
#include "run_file.hpp"

using namespace controller_system;

namespace {

constexpr const char* usage =
    "usage: visual_servoing [--virtual 10s | --real 5s] [--seed N] [--noise] [--dropped] [--slow] [--occlusion]\n"
    "                       [--unplugged 2s] [--run FILE] [--views FOLDER]\n"
    "--run writes what was recorded as JSON, --views some images of the camera with the features and their way.\n";

struct CommandLine {
    LoopSettings settings{};
    std::string run{};
    std::string views{};
    std::string wrong{};
};

// Seconds, with or without the unit; below 0 if it is no such thing.
double seconds(const char* text) {
    char* rest = nullptr;
    const double value = std::strtod(text, &rest);
    return rest != text && (*rest == '\0' || std::strcmp(rest, "s") == 0) && value > 0 && value <= 3600 ? value : -1;
}

CommandLine read(int count, char** words) {
    CommandLine line;
    Disturbances& wrong = line.settings.disturbances;
    const std::pair<const char*, bool*> switches[] = {
        {"--noise", &wrong.noise}, {"--dropped", &wrong.dropped}, {"--slow", &wrong.slow}, {"--occlusion", &wrong.occlusion}};
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        bool known = false;
        for (const auto& [name, value] : switches) {
            if (word == name) {
                *value = known = true;
            }
        }
        if (known) {
            continue;
        }
        const char* value = i + 1 < count ? words[++i] : "";
        char* rest = nullptr;
        if ((word == "--virtual" || word == "--real") && seconds(value) > 0) {
            line.settings.is_real = word == "--real";
            line.settings.span_ns = static_cast<std::int64_t>(seconds(value) * 1e9);
        } else if (word == "--unplugged" && seconds(value) > 0) {
            wrong.unplugged_s = seconds(value);
        } else if (word == "--seed" && *value != '\0' && *value != '-' &&
                   (line.settings.seed = std::strtoull(value, &rest, 10), *rest == '\0')) {
        } else if (word == "--run" && *value != '\0') {
            line.run = value;
        } else if (word == "--views" && *value != '\0') {
            line.views = value;
        } else {
            line.wrong = word + " " + value;
            return line;
        }
    }
    return line;
}

bool write_file(const std::string& path, const LoopSettings& settings, const Loop& loop) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    bool written = file != nullptr && write_run(file, settings, loop);
    written = file != nullptr && std::fclose(file) == 0 && written;
    if (!written) {
        std::fprintf(stderr, "visual_servoing: %s: %s\n", path.c_str(), std::strerror(errno));
    }
    return written;
}

}  // namespace

int main(int count, char** words) {
    const CommandLine line = read(count, words);
    if (!line.wrong.empty()) {
        std::fprintf(stderr, "visual_servoing: not understood: %s\n%s", line.wrong.c_str(), usage);
        return 2;
    }
    const Loop loop = run(line.settings);
    for (const TaskAccount& task : loop.tasks) {
        std::printf("%-16s %7lld cycles, %lld deadlines missed, at most %.1f us late\n", task.name.c_str(),
                    static_cast<long long>(task.cycles), static_cast<long long>(task.deadlines_missed),
                    static_cast<double>(task.worst_lateness_ns) * 1e-3);
    }
    if (!loop.failure.empty()) {
        std::fprintf(stderr, "visual_servoing: %s\n", loop.failure.c_str());
    }
    std::printf("camera: %lld images, %lld lost; searched whole %ld times\n", static_cast<long long>(loop.frames.delivered),
                static_cast<long long>(loop.frames.lost), loop.servoing->searches());
    std::printf("features %.1e, camera %.2f mm and %.3f degrees from the last goal: %s\n", loop.feature_error,
                loop.position_error * 1e3, loop.turn_error * 180 / M_PI,
                loop.converged() ? "converged" : loop.holding ? "holding, without images" : "not converged");

    bool written = line.run.empty() || write_file(line.run, line.settings, loop);
    if (!line.views.empty()) {
        const std::size_t pictures = write_pictures(line.views, loop);
        std::printf("%zu views in %s\n", pictures, line.views.c_str());
        written = written && pictures > 0;
    }
    if (!written) {
        return 2;
    }
    const bool at_rest = loop.holding && line.settings.disturbances.unplugged_s > 0 && loop.fastest < 5e-3;
    return loop.converged() || at_rest ? 0 : 1;
}
