// A system of generated tasks: started together, supervised, stopped safely.
//
// In: the plan, and the tasks as units. Out: an Ending that says whether the run reached its end, or which task failed,
// in which cycle, and why. A hook that throws ends only its own task; the supervisor notices, stops the others, and
// calls the components' safe_stop() in the order of the plan. A hook that never returns cannot be ended. The task is
// reported as hung when it makes no progress for a number of its periods; the others are stopped safely, and its thread
// is left alone. The program must then end without waiting for it (program.hpp does). Virtual time stands still while a
// hook computes: there a guard looks at the wall clock, and takes the turn away from a task that has had it for too
// long.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "asynchronous_task.hpp"
#include "locked_buffer.hpp"
#include "periodic_task.hpp"
#include "phases.hpp"
#include "wait_free_buffer.hpp"

namespace groundstate {

/// What a chart says of a task.
struct TaskPlan {
    const char* name = "";
    std::int64_t period_ticks = 0;  ///< 0: asynchronous
    std::int64_t jitter_ticks = 0;  ///< how much later than its period a cycle may be released
    std::int64_t offset_ticks = 0;
    std::int64_t deadline_ticks = 0;
    std::int64_t busy_ticks = 0;  ///< a cycle's time without any waiting
    int rank = 0;                 ///< the shorter the period, the more urgent
    bool single_phase = false;
    const char* awaits = "";  ///< the channel whose data wake an asynchronous task; `all` or `any`, and several
};

/// What a chart says about a system; all names are literals.
struct SystemPlan {
    const char* name = "";
    std::int64_t tick_ns = 1;
    std::vector<TaskPlan> tasks{};
    std::vector<const char*> names{};         ///< of phases, channels and components, as events number them
    std::vector<const char*> wait_free{};     ///< channels that are not as the model has them
    std::vector<std::size_t> safe_stop{};     ///< the order in which components are told
    std::vector<BoundPlan> bounds{};          ///< what tasks count by themselves
    std::vector<WayPlan> ways{};              ///< what bounds the ages of data
};

/// How a system is run.
struct Options {
    Pacing pacing{};              ///< of virtual time; the tick is the plan's
    std::string log{};            ///< the file for the events; none if empty
    int priority = 0;             ///< of SCHED_FIFO for the least urgent task; 0 asks for nothing
    int patience_periods = 10;    ///< so many periods without progress mean that a task hangs,
    std::int64_t patience_ns = 500'000'000;       ///< and so much time at the least
    std::int64_t guard_ns = 10'000'000'000;       ///< of the wall clock: how long a hook may compute in virtual time
    std::int64_t lock_patience_ns = 200'000'000;  ///< what an asynchronous task may wait in a cycle, for locks and room
    Late late = Late::catch_up;
};

/// How a run came to its end.
struct Ending {
    enum class Kind { ended, faulted, hung } kind = Kind::ended;
    std::string task{};
    std::int64_t cycle = 0;
    std::string phase{};
    std::string reason{};
    int log_error = 0;          ///< the system's number of what ended the log, or 0
    std::int64_t log_lost = 0;  ///< events that are missing in it
    bool realtime_refused = false;

    explicit operator bool() const noexcept { return kind == Kind::ended; }
};

/// A task as its supervisor knows it.
class Unit {
  public:
    virtual ~Unit() = default;
    virtual void start(std::int64_t origin_ns) = 0;
    virtual void ask_to_stop() noexcept = 0;
    virtual void stop() noexcept = 0;
    virtual void abandon() noexcept = 0;
    virtual TaskState state() const noexcept = 0;
    virtual std::exception_ptr failure() const noexcept = 0;
    virtual Granted granted() const noexcept = 0;
    virtual const Statistics& statistics() const noexcept = 0;
    virtual const Watchdog& watchdog() const noexcept = 0;
};

/// A periodic or asynchronous task as a unit.
template <class Task>
class UnitOf final : public Unit {
  public:
    explicit UnitOf(Task& task) noexcept : task_{task} {}
    void start(std::int64_t origin_ns) override { task_.start(origin_ns); }
    void ask_to_stop() noexcept override { task_.ask_to_stop(); }
    void stop() noexcept override { task_.stop(); }
    void abandon() noexcept override { task_.thread().abandon(); }
    TaskState state() const noexcept override { return task_.thread().state(); }
    std::exception_ptr failure() const noexcept override { return task_.thread().failure(); }
    Granted granted() const noexcept override { return task_.thread().granted(); }
    const Statistics& statistics() const noexcept override { return task_.statistics(); }
    const Watchdog& watchdog() const noexcept override { return task_.watchdog(); }

  private:
    Task& task_;
};

/// What all generated systems have in common; the generated class adds channels and cycles.
template <Clock C>
class SystemBase {
  public:
    static constexpr bool is_virtual = !std::is_same_v<C, MonotonicClock>;

    SystemBase(const SystemBase&) = delete;
    SystemBase& operator=(const SystemBase&) = delete;
    virtual ~SystemBase() = default;

    /// Runs all tasks for this long, or until one fails. Who: the owner, once; in virtual time from a thread that has
    /// not entered the clock, which expects one thread more than there are tasks. Blocks. Allocates.
    Ending run(std::int64_t span_ns) {
        Ending outcome;
        for (std::size_t i = 0; i < units_.size() && outcome; ++i) {
            try {
                start_component(i);
            } catch (...) {
                outcome = failed(i, std::current_exception());
                outcome.phase = "start";
            }
        }
        if (!outcome) {
            stop_components();
            return outcome;
        }
        const std::int64_t origin_ns = is_virtual ? 0 : clock_.now_ns() + 5'000'000;
        open_log(origin_ns);
        if (!start_units(origin_ns, outcome)) {
            stop_components();
            return outcome;
        }
        [[maybe_unused]] const auto guard = start_guard();
        clock_.enter(first_rank);
        outcome = watch(origin_ns, later_ns(origin_ns, span_ns));
        const std::int64_t stopped_ns = clock_.now_ns() - origin_ns;
        if (recorder_ != nullptr) {
            recorder_->stopping(stopped_ns);
        }
        for (const auto& unit : units_) {
            unit->ask_to_stop();
        }
        clock_.leave();
        ending_.store(true, std::memory_order_relaxed);
        end(outcome);
        stop_components();
        end_bounds(origin_ns + stopped_ns);
        close_log(outcome, stopped_ns);
        return outcome;
    }

    // Who: any thread. Block: no.
    const SystemPlan& plan() const noexcept { return plan_; }
    const Unit& unit(std::size_t task) const noexcept { return *units_[task]; }
    const TaskContext<C>& context(std::size_t task) const noexcept { return *contexts_[task]; }
    /// What was seen of all that the chart bounds. Allocates: yes.
    std::vector<BoundAccount> bounds() const {
        std::vector<BoundAccount> all;
        for (const auto& context : contexts_) {
            for (const Bound& bound : context->bounds()) {
                all.push_back(bound.account());
            }
        }
        for (const auto& way : ways_) {
            all.push_back(way->bound().account());
        }
        return all;
    }

  protected:
    SystemBase(C& clock, SystemPlan plan, const Options& options)
        : clock_{clock}, plan_{std::move(plan)}, options_{options} {
        options_.pacing.tick_ns = plan_.tick_ns;
        for (std::size_t i = 0; i < plan_.tasks.size(); ++i) {
            contexts_.push_back(
                std::make_unique<TaskContext<C>>(clock_, options_.pacing, static_cast<std::uint16_t>(i)));
        }
        for (const BoundPlan& bound : plan_.bounds) {
            contexts_[bound.task]->count(bound);
        }
        for (const WayPlan& way : plan_.ways) {
            ways_.push_back(std::make_unique<Way>(way, plan_.tick_ns));
            for (const auto& context : contexts_) {
                context->is_on(*ways_.back());
            }
        }
    }

    /// The component's own hooks around a run.
    virtual void start_component(std::size_t task) = 0;
    virtual void safe_stop_component(std::size_t task) noexcept = 0;

    TaskContext<C>& task(std::size_t number) noexcept { return *contexts_[number]; }

    Observation<C> observe(std::uint16_t channel, std::size_t from, std::size_t to, Side master, Side urgent) {
        return {channel, task(from), task(to), master, urgent};
    }

    Period period(std::size_t number) const {
        const TaskPlan& plan = plan_.tasks[number];
        const std::int64_t tick_ns = plan_.tick_ns;
        return {.period_ns = plan.period_ticks * tick_ns,
                .offset_ns = plan.offset_ticks * tick_ns,
                .deadline_ns = plan.deadline_ticks * tick_ns,
                // A cycle keeps its deadline even if it is released as late as it may be.
                .elaboration_ns = (plan.busy_ticks + plan.jitter_ticks) * tick_ns,
                .late = options_.late};
    }

    Schedule schedule(std::size_t number) const {
        const TaskPlan& plan = plan_.tasks[number];
        const int urgency = static_cast<int>(plan_.tasks.size()) - 1 - plan.rank;
        return {.realtime = {.priority = options_.priority == 0 ? 0 : options_.priority + urgency, .processor = -1},
                .rank = plan.rank,
                .grain_ns = contexts_[number]->pace.is_modelled() ? plan_.tick_ns : 1,
                // Virtual time follows the model, whose watchdog knows no lateness.
                .counts_lateness = !is_virtual,
                // The supervisor tells, and stops the others.
                .failed = [](const std::string&, const std::exception_ptr&) {}};
    }

    std::int64_t lock_patience_ns() const noexcept { return options_.lock_patience_ns; }

    /// Now, as deadlines see it: in modelled time the present tick.
    std::int64_t instant_ns(std::size_t number) const noexcept {
        return contexts_[number]->instant_ns();
    }

    /// An asynchronous task that awaits nothing is ready again when a cycle would be over, as the model has it.
    void rest_for_a_cycle(std::size_t number, const Cycle& cycle) {
        if (!contexts_[number]->pace.is_modelled()) {
            clock_.sleep_until_ns(cycle.start_ns + plan_.tasks[number].busy_ticks * plan_.tick_ns);
        }
    }

    /// A cycle of a task: its phases, with progress counted and a failure recorded.
    template <class Body>
    void cycle(std::size_t number, const Cycle& cycle, Body&& body) {
        TaskContext<C>& own = task(number);
        own.begin_cycle(cycle.number);
        if (cycle.rested) {
            own.released(own.instant_ns() - cycle.start_ns);
        }
        own.ways_begin();
        own.pace.begin_cycle(plan_.tasks[number].single_phase);
        Phases<C> phases{own, cycle};
        try {
            body(phases);
        } catch (...) {
            own.record(Kind::faults, own.phase(), static_cast<std::uint64_t>(cycle.number));
            own.at_rest();
            throw;
        }
        own.ways_end();
        own.pace.end_cycle();
        own.at_rest();
    }

    template <class Task>
    void add(Task& task) {
        units_.push_back(std::make_unique<UnitOf<Task>>(task));
    }

    C& clock() noexcept { return clock_; }

  private:
    static constexpr int first_rank = -1;
    static constexpr std::int64_t check_ns = 10'000'000;

    // It may be impossible to start a thread. In virtual time those that started wait for all, and are left alone.
    bool start_units(std::int64_t origin_ns, Ending& outcome) {
        for (std::size_t i = 0; i < units_.size(); ++i) {
            try {
                units_[i]->start(origin_ns);
            } catch (...) {
                outcome = failed(i, std::current_exception());
                outcome.phase = "start";
                outcome.kind = is_virtual ? Ending::Kind::hung : Ending::Kind::faulted;
                for (std::size_t j = 0; j < i; ++j) {
                    is_virtual ? units_[j]->abandon() : units_[j]->stop();
                }
                return false;
            }
        }
        return true;
    }

    Ending watch(std::int64_t origin_ns, std::int64_t end_ns) {
        bool told = false;
        for (std::int64_t next_ns = origin_ns;;) {
            next_ns = std::min(next_ns + check_ns, end_ns);
            clock_.sleep_until_ns(next_ns);
            for (std::size_t i = 0; i < units_.size(); ++i) {
                if (units_[i]->state() == TaskState::faulted) {
                    return failed(i, units_[i]->failure());
                }
                if (hangs(i)) {
                    return hung(i);
                }
            }
            told = told || warn_of_scheduling();
            if (next_ns >= end_ns) {
                return {};
            }
        }
    }

    bool hangs(std::size_t number) const noexcept {
        if constexpr (is_virtual) {
            return (evicted_.load(std::memory_order_relaxed) >> plan_.tasks[number].rank & 1) != 0;
        } else {
            const TaskPlan& plan = plan_.tasks[number];
            const std::int64_t period_ns = std::max(plan.period_ticks, plan.busy_ticks) * plan_.tick_ns;
            const std::int64_t waiting_ns = plan.period_ticks == 0 ? options_.lock_patience_ns : 0;
            const std::int64_t patience_ns =
                waiting_ns + std::max(options_.patience_ns, options_.patience_periods * period_ns);
            const std::int64_t progress_ns = contexts_[number]->progress_ns();
            return progress_ns != never_ns && clock_.now_ns() - progress_ns > patience_ns;
        }
    }

    // In virtual time, a thread that looks at the wall clock; it ends when the returned object goes out of scope.
    auto start_guard() {
        if constexpr (is_virtual) {
            return std::jthread{[this](const std::stop_token& stop) { guard(stop); }};
        } else {
            return 0;
        }
    }

    // As long as turns are given, all is well. If not, the thread that has the turn hangs. Or, if the tasks are ending
    // and no thread has the turn, all those left hang: time no longer goes on for them.
    void guard(const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any woken;
        std::unique_lock lock{mutex};
        std::uint64_t turns = clock_.turns();
        const std::int64_t pause_ns = std::min<std::int64_t>(options_.guard_ns / 4 + 1, 100'000'000);
        // It counts how often it looked, not the time: a program that was stopped meanwhile does not hang.
        std::int64_t still_ns = 0;
        while (!woken.wait_for(lock, stop, std::chrono::nanoseconds{pause_ns}, [&] { return stop.stop_requested(); })) {
            still_ns = clock_.turns() == turns ? still_ns + pause_ns : 0;
            turns = clock_.turns();
            if (still_ns >= options_.guard_ns) {
                const std::optional<int> rank = clock_.evict(first_rank + 1);
                const bool stuck = !rank && ending_.load(std::memory_order_relaxed);
                evicted_.fetch_or(rank ? std::uint64_t{1} << *rank : stuck ? ~std::uint64_t{0} : 0, std::memory_order_relaxed);
                still_ns = 0;
            }
        }
    }

    // Those that do not end within the patience are left alone.
    void end(Ending& outcome) {
        for (std::size_t i = 0; i < units_.size(); ++i) {
            while (units_[i]->state() == TaskState::running && !hangs(i)) {
                std::this_thread::sleep_for(std::chrono::milliseconds{1});
            }
            if (units_[i]->state() == TaskState::running) {
                if (outcome) {
                    outcome = hung(i);
                }
                units_[i]->abandon();
            } else {
                units_[i]->stop();
                if (outcome && units_[i]->state() == TaskState::faulted) {
                    outcome = failed(i, units_[i]->failure());
                }
            }
        }
    }

    void stop_components() noexcept {
        for (const std::size_t number : plan_.safe_stop) {
            safe_stop_component(number);
        }
    }

    Ending failed(std::size_t number, std::exception_ptr failure) const {
        Ending outcome = at(number, Ending::Kind::faulted);
        outcome.reason = reason_of(failure);
        return outcome;
    }

    Ending hung(std::size_t number) const {
        Ending outcome = at(number, Ending::Kind::hung);
        const std::int64_t still_ns = is_virtual ? options_.guard_ns : clock_.now_ns() - contexts_[number]->progress_ns();
        outcome.reason = "no progress for " + std::to_string(still_ns / 1'000'000) + " ms" + (is_virtual ? " of the wall clock" : "");
        return outcome;
    }

    Ending at(std::size_t number, Ending::Kind kind) const {
        Ending outcome;
        outcome.kind = kind;
        outcome.task = plan_.tasks[number].name;
        outcome.cycle = contexts_[number]->cycle();
        outcome.phase = plan_.names[contexts_[number]->phase()];
        return outcome;
    }

    // Said once; the statistics tell what it costs.
    bool warn_of_scheduling() {
        for (const auto& unit : units_) {
            if (unit->granted().priority == Grant::refused) {
                realtime_refused_ = true;
                std::fprintf(stderr, "%s: no permission for real-time scheduling (ulimit -r, or CAP_SYS_NICE); goes on "
                             "with the usual one, less punctually\n", plan_.name);
                return true;
            }
        }
        return false;
    }

    void open_log(std::int64_t origin_ns) {
        if (options_.log.empty()) {
            return;
        }
        std::vector<std::string> tasks;
        for (const TaskPlan& task : plan_.tasks) {
            tasks.emplace_back(task.name);
        }
        std::string wait_free;
        for (const char* channel : plan_.wait_free) {
            wait_free += (wait_free.empty() ? "" : " ") + std::string{channel};
        }
        const bool modelled = contexts_[0]->pace.is_modelled();
        McapFile::Map about{{"system", plan_.name},
                            {"tick_ns", std::to_string(plan_.tick_ns)},
                            {"time", is_virtual ? "virtual" : "real"},
                            {"pace", modelled ? "modelled" : is_virtual ? "drawn" : "real"},
                            {"wait_free", wait_free}};
        for (const TaskPlan& task : plan_.tasks) {
            tell_timing(task, about);
        }
        recorder_ = std::make_unique<Recorder>(options_.log, tasks,
                                               std::vector<std::string>(plan_.names.begin(), plan_.names.end()), about,
                                               is_virtual ? WhenFull::wait : WhenFull::lose,
                                               [this, origin_ns] { return clock_.now_ns() - origin_ns; });
        for (std::size_t i = 0; i < contexts_.size(); ++i) {
            contexts_[i]->record_to(&recorder_->log(i), origin_ns);
        }
    }

    // The data from which a reader of the log computes when a cycle was due.
    void tell_timing(const TaskPlan& task, McapFile::Map& about) const {
        const std::string name = task.name;
        const auto tell = [&](const char* what, std::int64_t ticks) {
            about.emplace_back(what + (" " + name), std::to_string(ticks * plan_.tick_ns));
        };
        if (task.period_ticks > 0) {
            tell("period_ns", task.period_ticks);
            tell("offset_ns", task.offset_ticks);
            tell("deadline_ns", task.deadline_ticks > 0 ? task.deadline_ticks : task.period_ticks);
        } else if (*task.awaits != '\0') {
            about.emplace_back("awaits " + name, task.awaits);
        }
    }

    // Those of tasks that hang are left alone.
    void end_bounds(std::int64_t stopped_ns) noexcept {
        for (std::size_t i = 0; i < contexts_.size(); ++i) {
            if (units_[i]->state() != TaskState::running) {
                for (Bound& bound : contexts_[i]->bounds()) {
                    bound.end(stopped_ns);
                }
            }
        }
    }

    // What was seen of the chart's bounds, each by its number.
    static void tell_bounds(const std::vector<BoundAccount>& bounds, McapFile::Map& about) {
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            const BoundAccount& bound = bounds[i];
            const std::string number = " " + std::to_string(i);
            about.emplace_back("bound" + number, bound.what);
            about.emplace_back("limit" + number, bound.limit);
            about.emplace_back("seen" + number, std::to_string(bound.seen));
            about.emplace_back("below" + number, std::to_string(bound.below));
            about.emplace_back("beyond" + number, std::to_string(bound.beyond));
            about.emplace_back((bound.is_time ? "greatest_ns" : "greatest") + number, std::to_string(bound.greatest));
        }
    }

    void close_log(Ending& outcome, std::int64_t stopped_ns) {
        outcome.realtime_refused = realtime_refused_;
        if (recorder_ == nullptr) {
            return;
        }
        McapFile::Map about{{"stopped_ns", std::to_string(stopped_ns)},
                            {"outcome", outcome ? "ended" : outcome.kind == Ending::Kind::hung ? "hung" : "faulted"}};
        if (!outcome) {
            about.emplace_back("task", outcome.task);
            about.emplace_back("cycle", std::to_string(outcome.cycle));
            about.emplace_back("reason", outcome.reason);
        }
        tell_bounds(bounds(), about);
        recorder_->finish(about);
        outcome.log_error = recorder_->error();
        outcome.log_lost = recorder_->lost();
    }

    C& clock_;
    SystemPlan plan_;
    Options options_;
    bool realtime_refused_ = false;
    std::atomic<std::uint64_t> evicted_{0};  ///< whom the guard found hanging, a bit a rank
    std::atomic<bool> ending_{false};
    // Before the units, which record until they have ended.
    std::unique_ptr<Recorder> recorder_{};
    std::vector<std::unique_ptr<Way>> ways_{};
    std::vector<std::unique_ptr<TaskContext<C>>> contexts_{};
    std::vector<std::unique_ptr<Unit>> units_{};
};

}  // namespace groundstate
