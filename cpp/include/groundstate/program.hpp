// The command line of a generated program: how long, in which time, with which log; the statistics; the exit status.
//
//     robot --virtual 10 --log run.mcap          ten seconds of virtual time, tick by tick as the model
//     robot --virtual 10 --seed 7                each phase lasts a part of its time, drawn from the seed
//     robot --real 3 --realtime 20               three seconds in real time, SCHED_FIFO from priority 20 on
//
// Exit status: 0 the run came to its end; 1 a task failed or hung, which is told; 2 wrong usage.
#pragma once

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
    std::string wrong{};
};

inline CommandLine read_command_line(int count, char** words) {
    CommandLine line;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const char* value = i + 1 < count ? words[i + 1] : nullptr;
        char* rest = nullptr;
        const double number = value != nullptr ? std::strtod(value, &rest) : 0;
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
#ifdef GROUNDSTATE_SEEDED_FAULTS
        } else if (word == "--seed-fault" && is_number && number <= 4) {
            seeded_fault = static_cast<Fault>(number);
#endif
        } else {
            line.wrong = word;
            return line;
        }
        ++i;
    }
    return line;
}

inline void report(const SystemPlan& plan, std::size_t i, const Unit& unit, std::int64_t invalid) {
    const Statistics& known = unit.statistics();
    std::printf("%-20s %9lld %9lld %9lld %9lld %9lld %12lld %12lld\n", plan.tasks[i].name,
                static_cast<long long>(known.cycles.value()), static_cast<long long>(known.deadlines_met.value()),
                static_cast<long long>(known.deadlines_missed.value()),
                static_cast<long long>(unit.watchdog().skipped()), static_cast<long long>(invalid),
                static_cast<long long>(known.worst_lateness_ns.value() / 1000),
                static_cast<long long>(known.worst_duration_ns.value() / 1000));
}

/// Tells how a run ended, and of each task what is known of its cycles.
template <class System>
int tell(const System& system, const Ending& outcome) {
    const SystemPlan& plan = system.plan();
    std::printf("%-20s %9s %9s %9s %9s %9s %12s %12s\n", "task", "cycles", "met", "missed", "skipped", "invalid",
                "late_us", "longest_us");
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
        report(plan, i, system.unit(i), system.context(i).invalid());
    }
    if (outcome.log_error != 0) {
        std::fprintf(stderr, "%s: the log ended early: %s\n", plan.name, std::strerror(outcome.log_error));
    }
    if (outcome.log_lost > 0) {
        std::fprintf(stderr, "%s: %lld events are missing in the log\n", plan.name,
                     static_cast<long long>(outcome.log_lost));
    }
    if (outcome) {
        return 0;
    }
    std::fprintf(stderr, "%s: task %s %s in cycle %lld, phase %s: %s; the others were stopped safely\n", plan.name,
                 outcome.task.c_str(), outcome.kind == Ending::Kind::hung ? "hung" : "failed",
                 static_cast<long long>(outcome.cycle), outcome.phase.c_str(), outcome.reason.c_str());
    return 1;
}

/// Runs a system with its hooks as the command line says. The value is main's.
template <template <class> class System, class Hooks>
int run_program(int count, char** words, const Hooks& hooks) {
    const CommandLine line = read_command_line(count, words);
    if (!line.wrong.empty()) {
        std::fprintf(stderr, "usage: %s [--virtual SECONDS [--seed N] | --real SECONDS [--realtime PRIORITY]] "
                     "[--log FILE]; not understood: %s\n", words[0], line.wrong.c_str());
        return 2;
    }
    if (const int error = McapFile::probe(line.options.log); error != 0) {
        std::fprintf(stderr, "%s: %s cannot be written: %s\n", words[0], line.options.log.c_str(), std::strerror(error));
        return 2;
    }
    const auto run = [&](auto& clock) {
        using C = std::remove_reference_t<decltype(clock)>;
        auto system = std::make_unique<System<C>>(clock, hooks, line.options);
        const Ending outcome = system->run(line.span_ns);
        const int status = tell(*system, outcome);
        if (outcome.kind == Ending::Kind::hung) {
            // A thread that never ends still uses the system.
            std::fflush(nullptr);
            std::_Exit(status);
        }
        return status;
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
