// The command line of a generated program: how long, in which time, with which log; the statistics; the exit status.
//
//     robot --virtual 10 --log run.mcap          ten seconds of virtual time, tick by tick as the model
//     robot --virtual 10 --seed 7                each phase lasts a part of its time, or a time of its interval, drawn from the seed
//     robot --real 3 --realtime 20               three seconds in real time, SCHED_FIFO from priority 20 on
//     robot --patience 2                         a task hangs if it makes no progress for 2 s (virtual time: 10, real: 0.5)
//
// Exit status: 0 the run reached its end; 1 a task failed or hung; 2 wrong usage; 3 the run reached its end, but data
// were not valid and so not handed over, or the log is not whole. A message says what failed.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "system.hpp"

namespace groundstate {

/// What the command line says.
struct CommandLine {
    Options options{};
    std::int64_t span_ns = 1'000'000'000;
    bool is_real = false;
    bool asks_help = false;
    std::string wrong{};
};

/// What a program says that is asked for help.
inline constexpr const char* program_help =
    "Runs the tasks of the system, for a second of virtual time unless said otherwise, and tells what they did.\n\n"
    "  --virtual SECONDS    in virtual time, tick by tick as the model\n"
    "  --real SECONDS       in real time\n"
    "  --seed N             each phase lasts a part of its time, or a time of its interval, drawn from the seed\n"
    "  --realtime PRIORITY  SCHED_FIFO from this priority on, 1 to 90\n"
    "  --patience SECONDS   a task hangs if it makes no progress for so long (virtual time: 10, real time: 0.5)\n"
    "  --log FILE           write the events, for `groundstate conform`\n"
    "  --help               this text\n\n"
    "Exit status: 0 the run came to its end; 1 a task failed or hung; 2 wrong usage; 3 the run came to its end, but data were not valid\n"
    "or events are missing in the log.\n";

inline CommandLine read_command_line(int count, char** words) {
    CommandLine line;
    // A word and its value each.
    for (int i = 1; i < count; i += 2) {
        const std::string word = words[i];
        const char* value = i + 1 < count ? words[i + 1] : nullptr;
        char* rest = nullptr;
        const double number = value != nullptr ? std::strtod(value, &rest) : 0;
        if (word == "--help" || word == "-h") {
            line.asks_help = true;
            return line;
        }
        const bool is_number = value != nullptr && *rest == '\0' && number >= 0 && number < 1e9;
        if ((word == "--virtual" || word == "--real") && is_number) {
            line.is_real = word == "--real";
            line.span_ns = static_cast<std::int64_t>(number * 1e9);
        } else if (word == "--seed" && is_number) {
            line.options.pacing.pace = Pace::drawn;
            line.options.pacing.seed = static_cast<std::uint64_t>(number);
        } else if (word == "--log" && value != nullptr) {
            line.options.log = value;
        } else if (word == "--realtime" && is_number && number >= 1 && number <= 90) {
            line.options.priority = static_cast<int>(number);
        } else if (word == "--patience" && is_number && number > 0) {
            line.options.patience_ns = line.options.guard_ns = static_cast<std::int64_t>(number * 1e9);
#ifdef GROUNDSTATE_SEEDED_FAULTS
        } else if (word == "--seed-fault" && is_number && number <= 4) {
            seeded_fault = static_cast<Fault>(number);
#endif
        } else {
            line.wrong = word;
            return line;
        }
    }
    return line;
}

/// What is known of a task's cycles after a run.
struct TaskAccount {
    std::string name{};
    std::int64_t cycles = 0;
    std::int64_t deadlines_met = 0;
    std::int64_t deadlines_missed = 0;
    std::int64_t skipped = 0;  ///< accesses given up by the watchdog
    std::int64_t invalid = 0;  ///< data that were not handed over
    std::int64_t worst_lateness_ns = 0;
    std::int64_t worst_duration_ns = 0;
};

/// What is left of a run when its system is gone.
struct RunAccount {
    std::string system{};
    std::vector<TaskAccount> tasks{};
    std::vector<BoundAccount> bounds{};  ///< what the chart bounds, and how often that was not kept
    Ending ending{};
};

template <class System>
RunAccount account_of(const System& system, Ending ending) {
    RunAccount account{system.plan().name, {}, system.bounds(), std::move(ending)};
    for (std::size_t i = 0; i < system.plan().tasks.size(); ++i) {
        const Statistics& known = system.unit(i).statistics();
        account.tasks.push_back({.name = system.plan().tasks[i].name,
                                 .cycles = known.cycles.value(),
                                 .deadlines_met = known.deadlines_met.value(),
                                 .deadlines_missed = known.deadlines_missed.value(),
                                 .skipped = system.unit(i).watchdog().skipped(),
                                 .invalid = system.context(i).invalid(),
                                 .worst_lateness_ns = known.worst_lateness_ns.value(),
                                 .worst_duration_ns = known.worst_duration_ns.value()});
    }
    return account;
}

/// All data were valid, and so handed over, and the log is whole, if there is one.
inline bool is_complete(const RunAccount& account) noexcept {
    bool is_valid = true;
    for (const TaskAccount& task : account.tasks) {
        is_valid = is_valid && task.invalid == 0;
    }
    return is_valid && account.ending.log_error == 0 && account.ending.log_lost == 0;
}

/// Prints what was seen of all that the chart bounds; nothing if it bounds nothing.
inline void tell_bounds(const std::vector<BoundAccount>& bounds) {
    if (bounds.empty()) {
        return;
    }
    std::printf("\n%-40s %-20s %9s %9s %12s\n", "bound", "limit", "seen", "outside", "most");
    for (const BoundAccount& bound : bounds) {
        std::array<char, 32> most{};
        if (bound.is_time) {
            std::snprintf(most.data(), most.size(), "%.1f us", static_cast<double>(bound.greatest) / 1e3);
        } else {
            std::snprintf(most.data(), most.size(), "%lld", static_cast<long long>(bound.greatest));
        }
        std::printf("%-40s %-20s %9lld %9lld %12s\n", bound.what.c_str(), bound.limit.c_str(),
                    static_cast<long long>(bound.seen), static_cast<long long>(bound.outside()), most.data());
    }
}

/// Prints how a run ended, and what is known of the cycles of each task. The exit status: 1 if a task failed, 3 if
/// something is missing all the same, or 0.
inline int tell(const RunAccount& account) {
    const char* name = account.system.c_str();
    const Ending& outcome = account.ending;
    std::printf("%-20s %9s %9s %9s %9s %9s %12s %12s\n", "task", "cycles", "met", "missed", "skipped", "invalid",
                "late_us", "longest_us");
    for (const TaskAccount& task : account.tasks) {
        std::printf("%-20s %9lld %9lld %9lld %9lld %9lld %12lld %12lld\n", task.name.c_str(),
                    static_cast<long long>(task.cycles), static_cast<long long>(task.deadlines_met),
                    static_cast<long long>(task.deadlines_missed), static_cast<long long>(task.skipped),
                    static_cast<long long>(task.invalid), static_cast<long long>(task.worst_lateness_ns / 1000),
                    static_cast<long long>(task.worst_duration_ns / 1000));
    }
    tell_bounds(account.bounds);
    if (outcome.log_error != 0) {
        std::fprintf(stderr, "%s: the log ended early: %s\n", name, std::strerror(outcome.log_error));
    }
    if (outcome.log_lost > 0) {
        std::fprintf(stderr, "%s: %lld events are missing in the log\n", name, static_cast<long long>(outcome.log_lost));
    }
    for (const TaskAccount& task : account.tasks) {
        if (task.invalid > 0) {
            std::fprintf(stderr, "%s: task %s made %lld data that are not valid; they were not handed over\n", name,
                         task.name.c_str(), static_cast<long long>(task.invalid));
        }
    }
    if (outcome) {
        return is_complete(account) ? 0 : 3;
    }
    std::fprintf(stderr, "%s: task %s %s in cycle %lld, phase %s: %s; the others were stopped safely\n", name,
                 outcome.task.c_str(), outcome.kind == Ending::Kind::hung ? "hung" : "failed",
                 static_cast<long long>(outcome.cycle), outcome.phase.c_str(), outcome.reason.c_str());
    return 1;
}

/// Runs a system for this long. If a task hung, prints what is known of the run and ends the program there, with exit
/// status 1: the task's thread still uses the system, and everything that its hooks refer to.
template <class System>
RunAccount run_to_account(System& system, std::int64_t span_ns) {
    Ending outcome = system.run(span_ns);
    const bool hung = outcome.kind == Ending::Kind::hung;
    RunAccount account = account_of(system, std::move(outcome));
    if (hung) {
        const int status = tell(account);
        std::fflush(nullptr);
        std::_Exit(status);
    }
    return account;
}

/// Runs a system with its hooks as the command line says. Returns the value for main.
template <template <class> class System, class Hooks>
int run_program(int count, char** words, const Hooks& hooks) {
    const CommandLine line = read_command_line(count, words);
    if (line.asks_help) {
        std::printf("usage: %s [OPTION]...\n%s", words[0], program_help);
        return 0;
    }
    if (!line.wrong.empty()) {
        std::fprintf(stderr, "usage: %s [--virtual SECONDS [--seed N] | --real SECONDS [--realtime PRIORITY]] "
                     "[--patience SECONDS] [--log FILE] [--help]; not understood: %s\n", words[0], line.wrong.c_str());
        return 2;
    }
    if (const int error = McapFile::probe(line.options.log); error != 0) {
        std::fprintf(stderr, "%s: %s cannot be written: %s\n", words[0], line.options.log.c_str(), std::strerror(error));
        return 2;
    }
    const auto run = [&](auto& clock) {
        using C = std::remove_reference_t<decltype(clock)>;
        auto system = std::make_unique<System<C>>(clock, hooks, line.options);
        return tell(run_to_account(*system, line.span_ns));
    };
    if (line.is_real) {
        if (line.options.priority > 0) {
            lock_memory();
        }
        MonotonicClock clock;
        return run(clock);
    }
    VirtualClock clock{System<VirtualClock>::threads};
    return run(clock);
}

}  // namespace groundstate
