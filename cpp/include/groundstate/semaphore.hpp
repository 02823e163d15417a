// A counting semaphore: first come, first served, and no user waits beyond its watchdog.
//
// The protocol of library/patterns/Semaphore.asm. The whole state, permits and line, is one word, so each operation is
// one atomic step. A release hands its permit over to the first in line: a later request never overtakes an earlier
// one, and no user starves. A user that gives up leaves the line, unless it already has the permit; then it keeps it.
// library/runtime/PermitLine.asm is this file step by atomic step.
//
//     | byte 0  | byte 1          | ... | byte 7         |
//     | permits | first in line   |     | last in line   |     0 stands for no user, u + 1 for user u
//
// INVARIANT: while a permit is free, no user is in line. LIMIT: seven users; no priority inheritance (pair_lock.hpp has
// it, for two). The watchdog bounds an inversion.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include "watchdog.hpp"

namespace groundstate {

/// Permits for users 0 to 6, in the order of their asking.
template <Clock C>
class Semaphore {
  public:
    static constexpr int users = 7;

    explicit Semaphore(C& clock, int permits = 1) noexcept : clock_{clock}, all_{static_cast<std::uint64_t>(permits)} {
        assert(permits > 0 && permits < 256);
    }

    Semaphore(const Semaphore&) = delete;
    Semaphore& operator=(const Semaphore&) = delete;

    /// Takes a permit, or gives up when the watchdog's budget is used up, which the watchdog counts.
    /// Who: only the user of that number, 0 to 6. Blocks: at most for the budget. Allocates: no.
    /// Worst case without contention: one atomic exchange; the time is read only to wait.
    [[nodiscard]] bool acquire(int user, Watchdog& watchdog) noexcept {
        assert(user >= 0 && user < users);
        switch (ask(user, watchdog.left_ns() > 0)) {
            case Answer::granted: return true;
            case Answer::refused: watchdog.skip(); return false;
            case Answer::in_line: break;
        }
        const std::int64_t start_ns = clock_.now_ns();
        const bool granted = stand_in_line(user, later_ns(start_ns, watchdog.left_ns()));
        watchdog.waited(clock_.now_ns() - start_ns);
        if (!granted) {
            watchdog.skip();
        }
        return granted;
    }

    /// Gives the permit to the first in line, or back. One release too many is counted and changes nothing.
    /// Who: a user that has a permit. Blocks: no. Allocates: no. Worst case: one exchange for each user that asks at
    /// the same time, and one system call if a task waits.
    void release() noexcept {
        std::uint64_t state = state_.load(std::memory_order_relaxed);
        for (;;) {
            const std::uint64_t line = state >> 8;
            if (line == 0 && state == all_) {
                illegal_.fetch_add(1, std::memory_order_relaxed);
                return;
            }
            const std::uint64_t released = line == 0 ? state + 1 : (line >> 8) << 8;
            // SYNC(permit): release. Everything done with the permit happens before what the next holder does: it sees
            // this exchange, or a later one of its release sequence (they are all exchanges), by an acquire.
            if (state_.compare_exchange_weak(state, released, std::memory_order_release, std::memory_order_relaxed)) {
                if (line != 0) {
                    call(static_cast<std::size_t>((line & 0xff) - 1));
                }
                return;
            }
        }
    }

    /// Who: any thread. Blocks: no.
    int permits() const noexcept { return static_cast<int>(state_.load(std::memory_order_relaxed) & 0xff); }
    /// Releases by a user that had no permit: a fault of the program. Who: any thread. Blocks: no.
    std::int64_t illegal_releases() const noexcept { return illegal_.load(std::memory_order_relaxed); }

  private:
    enum class Answer { granted, in_line, refused };

    // The user's place in line as a shift of the state; 64 if it is not in line.
    static int place_of(std::uint64_t state, int user) noexcept {
        int shift = 8;
        while (shift < 64 && ((state >> shift) & 0xff) != static_cast<std::uint64_t>(user) + 1) {
            shift += 8;
        }
        return shift;
    }

    Answer ask(int user, bool may_wait) noexcept {
        std::uint64_t state = state_.load(std::memory_order_relaxed);
        for (;;) {
            if ((state & 0xff) > 0) {
                // SYNC(permit): acquire, pairs with the exchange in release().
                if (state_.compare_exchange_weak(state, state - 1, std::memory_order_acquire,
                                                 std::memory_order_relaxed)) {
                    return Answer::granted;
                }
            } else if (!may_wait) {
                return Answer::refused;
            } else {
                int end = 8;
                while (((state >> end) & 0xff) != 0) {
                    end += 8;
                }
                const std::uint64_t joined = state | (static_cast<std::uint64_t>(user) + 1) << end;
                // relaxed: asking hands nothing over; it only goes on with the release sequence.
                if (state_.compare_exchange_weak(state, joined, std::memory_order_relaxed)) {
                    return Answer::in_line;
                }
            }
        }
    }

    // A user is served when it is out of the line: only a release takes it out, or the user itself.
    bool stand_in_line(int user, std::int64_t until_ns) noexcept {
        Word& calls = calls_[static_cast<std::size_t>(user)].count;
        for (;;) {
            // SYNC(call): acquire. If this sees the call, the next line sees that the user was taken out of the line.
            // If not, the wait below ends at once or is woken, because the count is no longer the one seen.
            const std::uint32_t seen = calls.load(std::memory_order_acquire);
            // SYNC(permit): acquire, pairs with the exchange in release() that took the user out of the line.
            if (place_of(state_.load(std::memory_order_acquire), user) == 64) {
                return true;
            }
            if (clock_.now_ns() >= until_ns) {
                return !leave_line(user);
            }
            clock_.wait_while(calls, seen, until_ns);
        }
    }

    // False if it was too late: the permit has been handed over.
    bool leave_line(int user) noexcept {
        for (;;) {
            // SYNC(permit): acquire, pairs with the exchange in release() that took the user out of the line.
            std::uint64_t state = state_.load(std::memory_order_acquire);
            const int place = place_of(state, user);
            if (place == 64) {
                return false;
            }
            const std::uint64_t before = state & ((std::uint64_t{1} << place) - 1);
            const std::uint64_t behind = (state >> place >> 8) << place;
            // relaxed, as asking: whoever leaves takes nothing over.
            if (state_.compare_exchange_weak(state, before | behind, std::memory_order_relaxed)) {
                return true;
            }
        }
    }

    void call(std::size_t user) noexcept {
        // SYNC(call): release, after the user was taken out of the line.
        calls_[user].count.fetch_add(1, std::memory_order_release);
        clock_.wake(calls_[user].count);
    }

    struct alignas(64) Calls {
        Word count{};
    };

    C& clock_;
    std::uint64_t all_;
    alignas(64) std::atomic<std::uint64_t> state_{all_};
    std::atomic<std::int64_t> illegal_{0};
    std::array<Calls, users> calls_{};
};

}  // namespace groundstate
