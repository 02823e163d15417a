// Virtual time: the same tasks, without the wall clock, and the same run each time.
//
// Of the threads that have entered, exactly one runs; the others stand in line or wait. When the running one sleeps or
// waits, the next goes on: first the ready ones, in the order of ranks. If none is ready, time jumps to the earliest
// instant until which a thread sleeps. Only sleeping takes time; computing does not. A run thus depends on ranks and
// instants alone, never on the machine.
//
// For tests and simulation; it locks, and is not meant for a control loop in real time. A thread sleeps until its turn
// on a word of its own, and the thread that gives the turn wakes only that one. These two system calls are most of what
// a run costs.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "clock.hpp"

namespace groundstate {

/// A clock that stands still while a thread works, and jumps when all sleep.
class VirtualClock {
  public:
    /// LIMIT: this many threads can live by one clock.
    static constexpr std::size_t seats = 32;

    /// Time stands still until this many threads have entered, so it does not matter in which order they start.
    explicit VirtualClock(std::size_t expected = 0) noexcept : expected_{expected} {}

    VirtualClock(const VirtualClock&) = delete;
    VirtualClock& operator=(const VirtualClock&) = delete;

    std::int64_t now_ns() const noexcept { return now_ns_.load(std::memory_order_acquire); }

    /// Takes part from now on; returns when it is the turn of the calling thread.
    void enter(int rank) noexcept {
        std::unique_lock guard{mutex_};
        take_seat(guard, rank);
    }

    /// Takes part no longer; the next one goes on.
    void leave() noexcept {
        std::unique_lock guard{mutex_};
        if (Seat* seat = mine(); seat != nullptr && seat->state != State::evicted) {
            hand_over(guard, stand_up(*seat));
        }
    }

    /// A thread that has not entered does so for the length of the call.
    void sleep_until_ns(std::int64_t instant_ns) noexcept {
        std::unique_lock guard{mutex_};
        while (now_ns() < instant_ns) {
            rest(guard, nullptr, instant_ns);
        }
    }

    void wait_while(Word& word, std::uint32_t seen, std::int64_t until_ns) noexcept {
        std::unique_lock guard{mutex_};
        if (word.load(std::memory_order_seq_cst) == seen && now_ns() < until_ns) {
            rest(guard, &word, until_ns);
        }
    }

    void wake(Word& word) noexcept {
        std::unique_lock guard{mutex_};
        for (Seat& seat : seats_) {
            if (seat.state == State::resting && seat.word == &word) {
                seat.state = State::ready;
            }
        }
        hand_over(guard, next());
    }

    /// How often a thread was given the turn. Who: any thread. Blocks: no.
    std::uint64_t turns() const noexcept { return turns_.load(std::memory_order_relaxed); }

    /// Takes the turn away for good from the thread that has it: the others go on, and that thread waits for ever at
    /// its next call. Returns its rank; nothing if no thread has the turn, or one of a lesser rank. Who: a guard that
    /// has seen no other turn for too long.
    std::optional<int> evict(int least_rank) noexcept {
        std::unique_lock guard{mutex_};
        for (Seat& seat : seats_) {
            if (seat.state == State::running && seat.rank >= least_rank) {
                seat.state = State::evicted;
                hand_over(guard, next());
                return seat.rank;
            }
        }
        return std::nullopt;
    }

  private:
    enum class State { empty, ready, running, resting, evicted };

    struct Seat {
        State state = State::empty;
        std::thread::id thread{};
        int rank = 0;
        std::int64_t until_ns = never_ns;
        const Word* word = nullptr;
        Word given{0};  ///< how often it was given the turn; what its thread sleeps on
    };

    Seat* mine() noexcept {
        for (Seat& seat : seats_) {
            if (seat.state != State::empty && seat.thread == std::this_thread::get_id()) {
                return &seat;
            }
        }
        return nullptr;
    }

    Seat& take_seat(std::unique_lock<std::mutex>& guard, int rank) noexcept {
        for (Seat& seat : seats_) {
            if (seat.state == State::empty) {
                seat.state = State::ready;
                seat.thread = std::this_thread::get_id();
                seat.rank = rank;
                ++present_;
                await_turn(guard, seat);
                return seat;
            }
        }
        assert(false && "more threads live by one virtual clock than it has seats");
        std::terminate();
    }

    // The thread that has the turn now, if it is another one than before.
    Seat* stand_up(Seat& seat) noexcept {
        seat.state = State::empty;
        --present_;
        return next();
    }

    // Lets the others go on until the word is woken or the instant has come.
    void rest(std::unique_lock<std::mutex>& guard, const Word* word, std::int64_t until_ns) noexcept {
        Seat* seat = mine();
        const bool guest = seat == nullptr;
        if (guest) {
            seat = &take_seat(guard, INT_MAX);
        }
        if (seat->state != State::evicted) {
            seat->state = State::resting;
        }
        seat->word = word;
        seat->until_ns = until_ns;
        await_turn(guard, *seat);
        if (guest) {
            hand_over(guard, stand_up(*seat));
            guard.lock();
        }
    }

    // Returns, with the mutex, when the seat has the turn; an evicted one never gets it.
    void await_turn(std::unique_lock<std::mutex>& guard, Seat& seat) noexcept {
        for (Seat* other = next(); seat.state != State::running; other = nullptr) {
            const std::uint32_t seen = seat.given.load(std::memory_order_relaxed);
            hand_over(guard, other);
            wall_.wait_while(seat.given, seen, never_ns);
            guard.lock();
        }
    }

    // Without the mutex, so that the woken thread does not run into it. The count was raised with it.
    void hand_over(std::unique_lock<std::mutex>& guard, Seat* next) noexcept {
        guard.unlock();
        if (next != nullptr) {
            wall_.wake(next->given);
        }
    }

    // INVARIANT: at most one seat runs. Gives the turn to the next one, if none has it; that one must be woken.
    Seat* next() noexcept {
        started_ = started_ || present_ >= expected_;
        Seat* first = nullptr;
        for (Seat& seat : seats_) {
            if (seat.state == State::running) {
                return nullptr;
            }
            if (seat.state != State::empty && seat.state != State::evicted && (first == nullptr || before(seat, *first))) {
                first = &seat;
            }
        }
        if (!started_ || first == nullptr || instant_of(*first) == never_ns) {
            return nullptr;  // all wait for data that only a thread outside can bring
        }
        now_ns_.store(std::max(now_ns(), instant_of(*first)), std::memory_order_release);
        first->state = State::running;
        turns_.fetch_add(1, std::memory_order_relaxed);
        first->given.fetch_add(1, std::memory_order_relaxed);
        return first;
    }

    // A ready thread goes on now, before those that sleep until this very instant.
    static std::int64_t instant_of(const Seat& seat) noexcept {
        return seat.state == State::ready ? -1 : seat.until_ns;
    }

    static bool before(const Seat& left, const Seat& right) noexcept {
        if (instant_of(left) != instant_of(right)) {
            return instant_of(left) < instant_of(right);
        }
        return left.rank < right.rank;
    }

    MonotonicClock wall_{};
    std::mutex mutex_{};
    std::array<Seat, seats> seats_{};
    std::size_t expected_;
    std::size_t present_ = 0;
    bool started_ = false;
    std::atomic<std::int64_t> now_ns_{0};
    std::atomic<std::uint64_t> turns_{0};
};

static_assert(Clock<VirtualClock>);

}  // namespace groundstate
