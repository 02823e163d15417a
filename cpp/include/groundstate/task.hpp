// What periodic and asynchronous tasks have in common: a thread, its settings, its statistics, and how it ends.
//
// A task is built, started once, and stopped. Its step is called in cycles, always by the task's own thread. A step
// that throws ends the task, which keeps the exception and calls the function in its schedule; the others go on.
// Everything is allocated before the first cycle. The statistics are those of library/patterns/Task.asm.
#pragma once

#include <array>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include "realtime.hpp"
#include "watchdog.hpp"

namespace groundstate {

/// The cycle that a step is called for.
struct Cycle {
    std::int64_t number = 0;              ///< from 0 on
    std::int64_t start_ns = 0;            ///< when it was due; in an asynchronous task: when it was woken
    std::int64_t deadline_ns = never_ns;  ///< when it must be done
    bool rested = true;                   ///< no cycle before it was still at work when it was due
    Watchdog& watchdog;                   ///< bounds the waiting of this cycle
};

using Step = std::function<void(const Cycle&)>;

/// How a task is scheduled. In virtual time, of the tasks ready at one instant, the one with the least rank goes first.
struct Schedule {
    Realtime realtime{};
    int rank = 0;
    std::int64_t grain_ns = 1;  ///< what times are whole multiples of: a tick, where virtual time follows a model's
    /// A cycle that begins late has that much less time to wait. The models count from its beginning instead.
    bool counts_lateness = true;
    /// Called when a step throws, which ends the task. Who: the task, as its last action; the clock of virtual time
    /// goes on when it returns. It may ask other tasks to stop. If there is no such function, standard error gets a
    /// message.
    std::function<void(const std::string& task, std::exception_ptr failure)> failed{};
};

/// What is known of a task's cycles since its start; each number is whole. One writer, the task.
struct Statistics {
    Counter cycles{};
    Counter deadlines_met{};
    Counter deadlines_missed{};
    Counter overruns{};           ///< cycles that were not done when the next one was due
    Counter periods_skipped{};    ///< left out to get back onto the grid
    Counter worst_lateness_ns{};  ///< from when a cycle was due to when it began
    Counter worst_duration_ns{};  ///< from when a cycle began to when it was done
};

enum class TaskState { built, running, stopped, faulted };

/// What an exception says of itself.
inline std::string reason_of(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const std::exception& error) {
        return error.what();
    } catch (...) {
        return "an exception that is none of std::exception";
    }
}

/// The thread of a task.
template <Clock C>
class TaskThread {
  public:
    TaskThread(C& clock, std::string name, Schedule schedule)
        : clock_{clock}, name_{std::move(name)}, schedule_{schedule} {}

    TaskThread(const TaskThread&) = delete;
    TaskThread& operator=(const TaskThread&) = delete;

    /// The owner asks the body to end beforehand; this only waits for it.
    ~TaskThread() { join(); }

    /// Who: the owner, once. Throws: std::system_error if no thread can be started.
    template <class Body>
    void start(Body body) {
        state_.store(TaskState::running, std::memory_order_relaxed);
        thread_ = std::thread{[this, body = std::move(body)] {
            // A thread's name has at most 15 letters.
            std::array<char, 16> name{};
            std::snprintf(name.data(), name.size(), "%s", name_.c_str());
            pthread_setname_np(pthread_self(), name.data());
            granted_.store(become_realtime(schedule_.realtime), std::memory_order_relaxed);
            clock_.enter(schedule_.rank);
            TaskState end = TaskState::stopped;
            try {
                body();
            } catch (...) {
                failure_ = std::current_exception();
                end = TaskState::faulted;
            }
            // SYNC(end): release; pairs with the acquire in state().
            state_.store(end, std::memory_order_release);
            if (end == TaskState::faulted) {
                tell_failure();
            }
            clock_.leave();
        }};
    }

    /// Who: the owner. Blocks: until the body has ended.
    void join() noexcept {
        if (thread_.joinable()) {
            thread_.join();
        }
    }

    /// Waits no longer for a body that does not end: its thread goes on by itself until the process ends.
    /// Who: the owner. What the body uses must stay; so this is for a program that is about to end.
    void abandon() noexcept {
        if (thread_.joinable()) {
            thread_.detach();
        }
    }

    /// Who: any thread. Blocks: no. Once it says stopped or faulted, `failure` may be asked.
    TaskState state() const noexcept {
        return state_.load(std::memory_order_acquire);  // SYNC(end)
    }

    /// What the step threw. Who: any thread, after the task has ended.
    std::exception_ptr failure() const noexcept { return failure_; }
    /// What the operating system granted; known before the first cycle. Who: any thread. Blocks: no.
    Granted granted() const noexcept { return granted_.load(std::memory_order_relaxed); }
    const std::string& name() const noexcept { return name_; }

  private:
    // An exception of `failed` itself has no caller left to go to.
    void tell_failure() noexcept {
        if (schedule_.failed) {
            schedule_.failed(name_, failure_);
            return;
        }
        const std::string reason = reason_of(failure_);
        std::fprintf(stderr, "task %s failed, and has ended: %s\n", name_.c_str(), reason.c_str());
    }

    C& clock_;
    std::string name_;
    Schedule schedule_;
    std::atomic<TaskState> state_{TaskState::built};
    std::atomic<Granted> granted_{Granted{}};
    static_assert(std::atomic<Granted>::is_always_lock_free);
    std::exception_ptr failure_{};
    std::thread thread_{};
};

}  // namespace groundstate
