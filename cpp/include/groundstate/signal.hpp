// What wakes a task: a count that rises when there is something to do.
//
// The waiter takes the count, looks whether there is something to do, and if not, waits while the count stays the same.
// Whatever comes in between has changed it, so no wake-up is lost. Raising is wait-free, and calls into the system only
// while a task waits.
#pragma once

#include "clock.hpp"

namespace groundstate {

/// A count of occasions; one task or more can wait on it.
template <Clock C>
class Signal {
  public:
    explicit Signal(C& clock) noexcept : clock_{clock} {}

    Signal(const Signal&) = delete;
    Signal& operator=(const Signal&) = delete;

    /// There is something to do. Who: any thread. Blocks: no. Allocates: no.
    /// Worst case: one atomic addition; one system call if a task waits.
    void raise() noexcept {
        // SYNC(sleeper): sequentially consistent, with the two in wait_while(). Either this addition comes first; then
        // the waiter finds another count and does not sleep. Or the waiter's comes first; then it is seen here, and the
        // waiter is woken.
        count_.fetch_add(1, std::memory_order_seq_cst);
        if (sleepers_.load(std::memory_order_seq_cst) != 0) {
            clock_.wake(count_);
        }
    }

    /// To be taken before looking whether there is something to do. Who: any thread. Blocks: no.
    std::uint32_t count() const noexcept { return count_.load(std::memory_order_acquire); }

    /// Returns when the signal was raised since the count was taken, at the instant, or for no reason.
    /// Who: any thread. Blocks: at most until the instant. Allocates: no.
    void wait_while(std::uint32_t seen, std::int64_t until_ns) noexcept {
        // SYNC(sleeper): announced first; then the clock compares the count, in one step with falling asleep.
        sleepers_.fetch_add(1, std::memory_order_seq_cst);
        clock_.wait_while(count_, seen, until_ns);
        sleepers_.fetch_sub(1, std::memory_order_relaxed);
    }

  private:
    C& clock_;
    Word count_{0};
    std::atomic<std::uint32_t> sleepers_{0};
};

}  // namespace groundstate
