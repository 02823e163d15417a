// A synchronous task: one cycle in each period, on a grid that does not drift.
//
// The grid is origin + offset + n * period, whenever the cycles really begin. A cycle is due on the grid, and meets its
// deadline if it is done by then (by the end of its period, unless set). A cycle that begins late does not move the
// grid: the next one is due when it always was, at once if necessary, as in library/patterns/{Task,Scheduler}.asm. A
// task that is overloaded for long would lag for ever; `Late::skip` leaves out the periods that have begun meanwhile,
// and counts them.
#pragma once

#include <cassert>

#include "task.hpp"

namespace groundstate {

/// What a task does that is late by whole periods.
enum class Late { catch_up, skip };

/// When the cycles of a task are due, and how long they take.
struct Period {
    std::int64_t period_ns = 0;
    std::int64_t offset_ns = 0;
    std::int64_t deadline_ns = 0;     ///< from when a cycle is due; 0: the period
    std::int64_t elaboration_ns = 0;  ///< a cycle's time without any waiting; what is left until the deadline may be waited
    Late late = Late::catch_up;
};

/// A task whose step is called once in each period.
template <Clock C>
class PeriodicTask {
  public:
    /// Who: the builder of the system. Allocates: yes.
    PeriodicTask(C& clock, std::string name, const Period& period, Step step, const Schedule& schedule = {})
        : clock_{clock},
          period_{period},
          step_{std::move(step)},
          grain_ns_{schedule.grain_ns},
          counts_lateness_{schedule.counts_lateness},
          // Where the work does not fit into the period, nothing is waited for.
          watchdog_{std::max<std::int64_t>(allowed_ns() - period.elaboration_ns, 0), schedule.grain_ns},
          thread_{clock, std::move(name), schedule} {
        assert(period.period_ns > 0 && period.elaboration_ns >= 0 && period.offset_ns >= 0);
    }

    ~PeriodicTask() { stop(); }

    /// The first cycle is due at the origin plus the offset. Tasks started with one origin keep step.
    /// Who: the owner, once. Allocates: yes. Throws: std::system_error if no thread can be started.
    void start(std::int64_t origin_ns) {
        thread_.start([this, origin_ns] { run(origin_ns + period_.offset_ns); });
    }

    /// No cycle begins any more. Who: any thread. Blocks: no.
    void ask_to_stop() noexcept {
        // SYNC(stop): relaxed: nothing is handed over. The clock compares the word in one step with falling asleep.
        stop_.store(1, std::memory_order_relaxed);
        clock_.wake(stop_);
    }

    /// Who: the owner; in virtual time after leaving the clock. Blocks: until the present cycle is done.
    void stop() noexcept {
        ask_to_stop();
        thread_.join();
    }

    /// Who: any thread. Blocks: no.
    const Statistics& statistics() const noexcept { return statistics_; }
    const Watchdog& watchdog() const noexcept { return watchdog_; }
    const TaskThread<C>& thread() const noexcept { return thread_; }
    TaskThread<C>& thread() noexcept { return thread_; }

  private:
    std::int64_t allowed_ns() const noexcept {
        return period_.deadline_ns > 0 ? period_.deadline_ns : period_.period_ns;
    }

    std::int64_t now_ns() const noexcept {
        const std::int64_t now_ns = clock_.now_ns();
        return now_ns - now_ns % grain_ns_;
    }

    void run(std::int64_t due_ns) {
        const std::int64_t allowed_ns = this->allowed_ns();
        for (std::int64_t number = 0;; ++number) {
            const bool rested = clock_.now_ns() < due_ns;
            if (!await(due_ns)) {
                return;
            }
            const std::int64_t begun_ns = now_ns();
            watchdog_.restart(counts_lateness_ ? begun_ns - due_ns : 0);
            step_({.number = number, .start_ns = due_ns, .deadline_ns = due_ns + allowed_ns, .rested = rested, .watchdog = watchdog_});
            account(due_ns, begun_ns, now_ns(), allowed_ns);
            due_ns = next_ns(due_ns, now_ns());
        }
    }

    // Rests until then; false: it was asked to stop.
    bool await(std::int64_t due_ns) noexcept {
        while (stop_.load(std::memory_order_relaxed) == 0) {  // SYNC(stop)
            if (clock_.now_ns() >= due_ns) {
                return true;
            }
            clock_.wait_while(stop_, 0, due_ns);
        }
        return false;
    }

    void account(std::int64_t due_ns, std::int64_t begun_ns, std::int64_t done_ns, std::int64_t allowed_ns) noexcept {
        statistics_.cycles.add();
        (done_ns - due_ns <= allowed_ns ? statistics_.deadlines_met : statistics_.deadlines_missed).add();
        if (done_ns > due_ns + period_.period_ns) {
            statistics_.overruns.add();
        }
        statistics_.worst_lateness_ns.raise_to(begun_ns - due_ns);
        statistics_.worst_duration_ns.raise_to(done_ns - begun_ns);
    }

    // On the grid, always.
    std::int64_t next_ns(std::int64_t due_ns, std::int64_t now_ns) noexcept {
        std::int64_t periods = 1;
        if (period_.late == Late::skip) {
            const std::int64_t begun = (now_ns - due_ns - 1) / period_.period_ns;  // before now, so that the next one is late
            statistics_.periods_skipped.add(begun);
            periods += begun;
        }
        return due_ns + periods * period_.period_ns;
    }

    C& clock_;
    Period period_;
    Step step_;
    std::int64_t grain_ns_;
    bool counts_lateness_;
    Watchdog watchdog_;
    Statistics statistics_{};
    Word stop_{0};
    TaskThread<C> thread_;
};

}  // namespace groundstate
