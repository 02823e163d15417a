// The command line of a robot's program, and how the program ends: what all of them have in common.
//
//     int main(int count, char** words) {
//         Settings settings;
//         closed_loop::CommandLine line{"robot", "The robot and a simulated cell, in closed loop", settings.run};
//         line.flag("--noise", settings.noise, "images with noise");
//         if (const auto status = line.read(count, words)) {
//             return *status;
//         }
//         const Loop loop = run(settings);
//         tell(loop.account);
//         std::printf("…\n");
//         return line.end(loop.account, loop.is_good(), [&](Json& json) { … });
//     }
//
// Exit status: 0 the verdict is good; 1 it is not, or a task failed; 2 wrong usage, or a file that cannot be written; 3 the
// verdict is good, but data were not valid and so not handed over, or the log is not whole (as of generated programs). What is
// wrong is told on stderr, and before anything runs as far as it can be known.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "disturbances.hpp"
#include "json.hpp"
#include "run.hpp"

namespace groundstate::closed_loop {

/// Reads the options. Every program has --virtual, --real, --seed, --realtime, --patience, --log, --run; others are
/// added before `read`. What is given here and there must outlive it.
class CommandLine {
  public:
    CommandLine(const char* program, const char* what, RunSettings& settings);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    void flag(const char* name, bool& value, const char* what);
    /// A time, as in 10s, 0.5s, 20ms.
    void seconds(const char* name, double& value, const char* what);
    /// From 0 to 1.
    void share(const char* name, double& value, const char* what);
    void number(const char* name, int& value, int least, int most, const char* what);
    /// One of the names, whose number becomes the value.
    void choice(const char* name, int& value, const std::vector<std::string>& names, const char* what);
    void folder(const char* name, std::string& value, const char* what);
    /// --noise, --dropped, --slow, --occlusion, --unplugged.
    void disturbances(Disturbances& wrong);

    /// Nothing: the program may run. Else its exit status, and all is told.
    std::optional<int> read(int count, char** words);

    /// A path as it is from the folder of the file that --run names; empty: of no path.
    std::string from_run_file(const std::string& path) const;

    /// Writes what --run asks for: an object with the settings, where the log is, the tasks, and what `columns` adds. The exit status of
    /// the program, as it was told already.
    int end(const RunAccount& account, bool is_good, const std::function<void(Json&)>& columns);

    /// Tells that the world failed, with the name of the program.
    void complain(const std::string& what) const;

  private:
    struct Options;

    const char* program_;
    RunSettings& settings_;
    std::string run_file_{};
    std::unique_ptr<Options> options_;
};

/// The keys `time`, `span_s`, `seed`.
void write_settings(Json& json, const RunSettings& settings);
/// The key `tasks`.
void write_tasks(Json& json, const RunAccount& account);
/// The key `disturbances`.
void write_disturbances(Json& json, const Disturbances& wrong);

}  // namespace groundstate::closed_loop
