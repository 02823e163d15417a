// The lock between two tasks: no task waits for it beyond its watchdog, and the holder is as urgent as the task that
// waits.
//
// In real time it is Linux's futex with priority inheritance: while the urgent task waits, the other runs at its
// priority, and no third task of a priority between delays both. The system hands the lock over to the one that waits,
// so with two users it comes in the order of asking, as in library/patterns/Semaphore.asm. Without contention it takes
// one exchange either way, and no system call. By any other clock it is a semaphore with one permit (semaphore.hpp):
// virtual time has no priorities that could be inverted.
#pragma once

#include <algorithm>
#include <cerrno>

#include "semaphore.hpp"

namespace groundstate {

/// For users 0 and 1, each a thread of its own.
template <Clock C>
class PairLock : public Semaphore<C> {
  public:
    explicit PairLock(C& clock) noexcept : Semaphore<C>{clock} {}
};

template <>
class PairLock<MonotonicClock> {
  public:
    explicit PairLock(MonotonicClock& clock) noexcept : clock_{clock} {}

    PairLock(const PairLock&) = delete;
    PairLock& operator=(const PairLock&) = delete;

    /// Takes it, or gives up when the watchdog's budget is used up, which the watchdog counts. Who: the one of the two
    /// that does not hold it; the holder is refused. Blocks: at most for the budget. Allocates: no. Worst case without
    /// contention: one exchange; the time is read only to wait.
    [[nodiscard]] bool acquire(int, Watchdog& watchdog) noexcept {
        if (is_taken()) {
            return true;
        }
        const std::int64_t left_ns = watchdog.left_ns();
        if (left_ns <= 0) {
            watchdog.skip();
            return false;
        }
        const std::int64_t start_ns = clock_.now_ns();
        const bool granted = wait_until(later_ns(start_ns, left_ns));
        watchdog.waited(clock_.now_ns() - start_ns);
        if (!granted) {
            watchdog.skip();
        }
        return granted;
    }

    /// Who: the task that holds it. Blocks: no. Allocates: no. Worst case: one exchange, and one system call if the
    /// other waits.
    void release() noexcept {
        // SYNC(hand): release, for the way through the system, which is not an atomic operation of this program.
        std::uint32_t own = thread();
        handed_.store(own, std::memory_order_release);
        // SYNC(permit): release; pairs with the exchange in is_taken().
        if (!holder_.compare_exchange_strong(own, 0, std::memory_order_release, std::memory_order_relaxed)) {
            Futex::call(holder_, FUTEX_UNLOCK_PI_PRIVATE, 0, never_ns, 0);
        }
    }

  private:
    bool is_taken() noexcept {
        std::uint32_t nobody = 0;
        // SYNC(permit): acquire; pairs with the exchange in release().
        if (!holder_.compare_exchange_strong(nobody, thread(), std::memory_order_acquire, std::memory_order_relaxed)) {
            return false;
        }
        // The last holder may have released through the system, for a task that has given up waiting since.
        take_over();
        return true;
    }

    /// What the holder before did is seen from here on.
    void take_over() const noexcept {
        // SYNC(hand): acquire; pairs with the store in release().
        static_cast<void>(handed_.load(std::memory_order_acquire));
    }

    bool wait_until(std::int64_t instant_ns) noexcept {
        for (int error = EAGAIN; error == EAGAIN || error == EINTR;) {
            error = wait(lock_by_monotonic_clock, instant_ns);
            if (error == ENOSYS || error == EINVAL) {
                // Linux before 5.14 waits for such a lock by the calendar alone.
                timespec today{};
                clock_gettime(CLOCK_REALTIME, &today);
                const std::int64_t today_ns = std::int64_t{today.tv_sec} * Futex::second_ns + today.tv_nsec;
                const std::int64_t left_ns = std::max<std::int64_t>(instant_ns - clock_.now_ns(), 0);
                error = wait(FUTEX_LOCK_PI_PRIVATE, later_ns(today_ns, left_ns));
            }
            if (error == ENOSYS) {
                // A system without such locks at all: the lock is polled.
                clock_.sleep_until_ns(std::min(instant_ns, clock_.now_ns() + 50'000));
                error = is_taken() ? 0 : clock_.now_ns() < instant_ns ? EAGAIN : ETIMEDOUT;
            }
            if (error == 0) {
                take_over();
                return true;
            }
        }
        return false;
    }

    // The system's number of an error, or 0.
    int wait(int operation, std::int64_t instant_ns) noexcept { return Futex::call(holder_, operation, 0, instant_ns, 0); }

    // The system's number of the calling thread; it identifies the holder.
    static std::uint32_t thread() noexcept {
        thread_local const auto number = static_cast<std::uint32_t>(syscall(SYS_gettid));
        return number;
    }

    static constexpr int lock_by_monotonic_clock = 13 | FUTEX_PRIVATE_FLAG;  // FUTEX_LOCK_PI2, which older headers lack

    MonotonicClock& clock_;
    alignas(64) Word holder_{0};  ///< 0, or the holder's number, with the system's mark if the other waits
    Word handed_{};  ///< the number of the last one that released
};

}  // namespace groundstate
