// An asynchronous task: woken by data, one cycle each time there is something to do.
//
// What it awaits raises its `trigger()`: a swinging buffer or a message queue does so by `wakes`; several may raise the
// same one. The task then asks `available` whether there is something to do, and steps until there is not. It never polls. Waiting for data is its
// rest, and has no bound; waiting for locks within a cycle has the watchdog's bound.
#pragma once

#include <cassert>

#include "signal.hpp"
#include "task.hpp"

namespace groundstate {

/// A task whose step is called when there is something to do.
template <Clock C>
class AsynchronousTask {
  public:
    using Available = std::function<bool()>;

    /// `patience_ns`, not 0, is the time that one cycle may spend waiting. A step must take what made `available` true;
    /// otherwise it is called again at once. Who: the builder of the system. Allocates: yes.
    AsynchronousTask(C& clock, std::string name, std::int64_t patience_ns, Available available, Step step,
                     const Schedule& schedule = {})
        : clock_{clock},
          available_{std::move(available)},
          step_{std::move(step)},
          trigger_{clock},
          watchdog_{patience_ns, schedule.grain_ns},
          thread_{clock, std::move(name), schedule} {
        assert(patience_ns > 0);
    }

    ~AsynchronousTask() { stop(); }

    /// What wakes the task. Who: the builder of the system, before the tasks start.
    Signal<C>& trigger() noexcept { return trigger_; }

    /// No cycle begins before the origin: tasks started with one origin begin together.
    /// Who: the owner, once. Allocates: yes. Throws: std::system_error if no thread can be started.
    void start(std::int64_t origin_ns = 0) {
        thread_.start([this, origin_ns] { run(origin_ns); });
    }

    /// No cycle begins any more. Who: any thread. Blocks: no.
    void ask_to_stop() noexcept {
        // SYNC(stop): relaxed, before the signal: a thread that the signal wakes sees it.
        stop_.store(true, std::memory_order_relaxed);
        trigger_.raise();
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
    void run(std::int64_t origin_ns) {
        clock_.sleep_until_ns(origin_ns);
        for (;;) {
            const std::uint32_t seen = trigger_.count();
            if (stop_.load(std::memory_order_relaxed)) {  // SYNC(stop): the count was taken first
                return;
            }
            if (available_()) {
                cycle();
            } else {
                trigger_.wait_while(seen, never_ns);
            }
        }
    }

    void cycle() {
        watchdog_.restart();
        const std::int64_t begun_ns = clock_.now_ns();
        step_({.number = statistics_.cycles.value(), .start_ns = begun_ns, .watchdog = watchdog_});
        statistics_.cycles.add();
        statistics_.worst_duration_ns.raise_to(clock_.now_ns() - begun_ns);
    }

    C& clock_;
    Available available_;
    Step step_;
    Signal<C> trigger_;
    Watchdog watchdog_;
    Statistics statistics_{};
    std::atomic<bool> stop_{false};
    TaskThread<C> thread_;
};

}  // namespace groundstate
