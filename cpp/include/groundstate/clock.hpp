// Time and waiting, in nanoseconds.
//
// A Clock tells the time, sleeps until an instant, and waits while a word keeps its value. The runtime waits in no
// other way, so a program for real time runs unchanged in virtual time (virtual_clock.hpp): every class below takes its
// clock as a parameter. A running robot uses MonotonicClock: CLOCK_MONOTONIC, clock_nanosleep, and the futex of Linux.
// POSIX has no such wait for a word, until an absolute monotonic instant, that costs the waker nothing while no thread
// waits.
#pragma once

#include <cerrno>
#include <climits>
#include <concepts>
#include <cstdint>
#include <ctime>

#include <atomic>
#include <type_traits>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace groundstate {

/// What a thread can wait for: it sleeps while the word keeps the value it has seen.
using Word = std::atomic<std::uint32_t>;

/// An instant that does not come.
inline constexpr std::int64_t never_ns = INT64_MAX;

/// `start + span`, at most `never_ns`. Both are at least 0.
constexpr std::int64_t later_ns(std::int64_t start_ns, std::int64_t span_ns) noexcept {
    return span_ns >= never_ns - start_ns ? never_ns : start_ns + span_ns;
}

/// A clock tells the time and waits.
///
///     now_ns()                       the time since some beginning; never goes back
///     sleep_until_ns(instant)        returns at the instant or after it
///     wait_while(word, seen, until)  returns when the word has changed, at the instant, or for no reason at all: the
///                                    caller looks again at what it waits for
///     wake(word)                     after a change of the word: threads that wait for it go on
///     enter(rank), leave()           the calling thread begins and ends to live by this clock; of the threads ready at
///                                    one instant of virtual time, the one with the least rank goes first
///
/// All may be called by any thread. None allocates.
template <class C>
concept Clock = requires(C& clock, const C& face, Word& word, std::uint32_t seen, std::int64_t instant_ns, int rank) {
    { face.now_ns() } noexcept -> std::same_as<std::int64_t>;
    { clock.sleep_until_ns(instant_ns) } noexcept;
    { clock.wait_while(word, seen, instant_ns) } noexcept;
    { clock.wake(word) } noexcept;
    { clock.enter(rank) } noexcept;
    { clock.leave() } noexcept;
};

/// Linux's futex. The kernel gets an instant in the form that the call's number asks for: where `long` has 32 bits and
/// the C library's time has 64, the old call would take half an instant for a whole one.
class Futex {
  public:
    static constexpr std::int64_t second_ns = 1'000'000'000;

    /// The system's number of an error, or 0. `until_ns` is `never_ns` for no bound. Blocks: as the operation does.
    static int call(Word& word, int operation, std::uint32_t value, std::int64_t until_ns, std::uint32_t bits) noexcept {
        static_assert(sizeof(Word) == sizeof(std::uint32_t) && Word::is_always_lock_free);
        const Instant until{until_ns};
        return syscall(number, &word, operation, value, until_ns == never_ns ? nullptr : &until, nullptr, bits) == 0
                   ? 0 : errno;
    }

    /// What `number` takes for an instant.
    template <class Part>
    struct InstantOf {
        Part seconds;
        Part nanoseconds;
        explicit constexpr InstantOf(std::int64_t instant_ns) noexcept
            : seconds{static_cast<Part>(instant_ns / second_ns)}, nanoseconds{static_cast<Part>(instant_ns % second_ns)} {}
    };

#ifdef SYS_futex_time64
    static constexpr bool has_both = sizeof(long) < sizeof(std::int64_t);
    static constexpr long number = has_both ? SYS_futex_time64 : SYS_futex;
    using Instant = InstantOf<std::conditional_t<has_both, std::int64_t, long>>;
#else
    static constexpr long number = SYS_futex;
    using Instant = InstantOf<long>;
#endif
};

/// Real time.
class MonotonicClock {
  public:
    /// Blocks: no. Worst case: one read of the clock, some 30 ns, without a system call on usual machines.
    std::int64_t now_ns() const noexcept {
        timespec now{};
        clock_gettime(CLOCK_MONOTONIC, &now);
        return std::int64_t{now.tv_sec} * Futex::second_ns + now.tv_nsec;
    }

    /// Blocks: until the instant, and as long after it as the scheduler takes.
    void sleep_until_ns(std::int64_t instant_ns) noexcept {
        const timespec instant = split(instant_ns);
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &instant, nullptr) == EINTR) {
        }
    }

    /// Blocks: at most until the instant.
    void wait_while(Word& word, std::uint32_t seen, std::int64_t until_ns) noexcept {
        // The result is ignored: a wait may end for no reason.
        Futex::call(word, FUTEX_WAIT_BITSET_PRIVATE, seen, until_ns, FUTEX_BITSET_MATCH_ANY);
    }

    /// Blocks: no. Worst case: one system call.
    void wake(Word& word) noexcept {
        // It wakes whom it finds.
        Futex::call(word, FUTEX_WAKE_BITSET_PRIVATE, INT_MAX, never_ns, FUTEX_BITSET_MATCH_ANY);
    }

    void enter(int) noexcept {}
    void leave() noexcept {}

  private:
    // A template, so that no compiler calls a cast useless where both types are the same.
    template <class Time = decltype(timespec::tv_sec), class Part = decltype(timespec::tv_nsec)>
    static timespec split(std::int64_t instant_ns) noexcept {
        return {.tv_sec = static_cast<Time>(instant_ns / Futex::second_ns),
                .tv_nsec = static_cast<Part>(instant_ns % Futex::second_ns)};
    }
};

static_assert(Clock<MonotonicClock>);

}  // namespace groundstate
