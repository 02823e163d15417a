// The lock between two tasks in real time: one at a time, nobody beyond his watchdog, no inversion of priorities.
#include "groundstate/pair_lock.hpp"

#include <gtest/gtest.h>

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>

#include <bit>
#include <cstddef>
#include <thread>

#include "groundstate/realtime.hpp"

namespace groundstate {
namespace {

constexpr std::int64_t ms = 1'000'000;

TEST(PairLock, IsGivenUpWhenTheWatchdogEnds) {
    MonotonicClock clock;
    PairLock<MonotonicClock> lock{clock};
    Watchdog holder{ms};
    ASSERT_TRUE(lock.acquire(0, holder));
    std::thread other{[&] {
        Watchdog none{0};
        EXPECT_FALSE(lock.acquire(1, none));
        EXPECT_EQ(none.total_wait_ns(), 0) << "not even the time is read";
        Watchdog least{1};
        EXPECT_FALSE(lock.acquire(1, least));
        EXPECT_GT(least.total_wait_ns(), 0);
        Watchdog some{5 * ms};
        const std::int64_t before_ns = clock.now_ns();
        EXPECT_FALSE(lock.acquire(1, some));
        const std::int64_t span_ns = clock.now_ns() - before_ns;
        EXPECT_GE(span_ns, 5 * ms);
        EXPECT_LE(some.total_wait_ns(), span_ns);
        EXPECT_EQ(some.left_ns(), 0);
        EXPECT_EQ(none.skipped() + least.skipped() + some.skipped(), 3);
    }};
    other.join();
    EXPECT_FALSE(lock.acquire(0, holder)) << "who holds it does not wait for himself";
    lock.release();
    Watchdog none{0};
    EXPECT_TRUE(lock.acquire(1, none)) << "a free lock costs no waiting";
    lock.release();
}

TEST(PairLock, HasOneHolder) {
    MonotonicClock clock;
    PairLock<MonotonicClock> lock{clock};
    long inside = 0;
    const auto work = [&](int user) {
        for (int i = 0; i < 20'000; ++i) {
            Watchdog watchdog{1000 * ms};
            ASSERT_TRUE(lock.acquire(user, watchdog));
            ++inside;
            lock.release();
        }
    };
    std::thread one{work, 0};
    std::thread other{work, 1};
    one.join();
    other.join();
    EXPECT_EQ(inside, 40'000);
}

// From now on the calling thread, and those that it starts, get this error for that call of the futex, as on another system. False: a
// thread may not ask for that here.
bool refuse(std::uint32_t operation, std::uint32_t error) {
    // The lower half of the second argument.
    constexpr std::uint32_t argument = offsetof(seccomp_data, args) + 8 + (std::endian::native == std::endian::big ? 4 : 0);
    std::array<sock_filter, 6> steps{{
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
        {BPF_JMP | BPF_JEQ | BPF_K, 0, 3, SYS_futex},
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, argument},
        {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, operation},
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | error},
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW},
    }};
    const sock_fprog program{.len = steps.size(), .filter = steps.data()};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

constexpr std::uint32_t by_monotonic_clock = 13 | FUTEX_PRIVATE_FLAG;
constexpr std::uint32_t by_calendar = FUTEX_LOCK_PI_PRIVATE;

// On a system that refuses these calls: one task holds the lock until the other has given up waiting, and a little longer.
void expect_the_lock_is_waited_for(std::initializer_list<std::pair<std::uint32_t, std::uint32_t>> refused) {
    std::thread{[&] {
        for (const auto& [operation, error] : refused) {
            if (!refuse(operation, error)) {
                std::puts("no permission to refuse calls of the system: its ways of waiting are not looked at");
                return;
            }
        }
        MonotonicClock clock;
        PairLock<MonotonicClock> lock{clock};
        Watchdog holder{60'000 * ms};
        ASSERT_TRUE(lock.acquire(0, holder));
        std::atomic<bool> has_given_up{false};
        int handed = 0;
        std::thread other{[&] {
            Watchdog some{5 * ms};
            const std::int64_t before_ns = clock.now_ns();
            EXPECT_FALSE(lock.acquire(1, some));
            EXPECT_GE(clock.now_ns() - before_ns, 5 * ms);
            EXPECT_EQ(some.skipped(), 1);
            has_given_up = true;
            Watchdog patient{60'000 * ms};
            EXPECT_TRUE(lock.acquire(1, patient));
            EXPECT_EQ(handed, 1) << "what was done under the lock is seen";
            lock.release();
        }};
        while (!has_given_up) {
            std::this_thread::yield();
        }
        // So that the other one most probably waits.
        clock.sleep_until_ns(clock.now_ns() + 2 * ms);
        handed = 1;
        lock.release();
        EXPECT_TRUE(lock.acquire(0, holder));
        lock.release();
        other.join();
    }}.join();
}

TEST(PairLock, IsWaitedForByTheCalendarWhereTheSystemHasNoOtherWay) {
    expect_the_lock_is_waited_for({{by_monotonic_clock, ENOSYS}});
    expect_the_lock_is_waited_for({{by_monotonic_clock, EINVAL}});
}

TEST(PairLock, IsPolledWhereTheSystemHasNoSuchLock) {
    expect_the_lock_is_waited_for({{by_monotonic_clock, ENOSYS}, {by_calendar, ENOSYS}});
}

TEST(PairLock, IsNotWaitedForByTheCalendarWhereTheSystemHasAnotherWay) {
    Word word{0};
    if (Futex::call(word, static_cast<int>(by_monotonic_clock), 0, never_ns, 0) != 0) {
        std::puts("Linux before 5.14 has no other way");
        return;
    }
    expect_the_lock_is_waited_for({{by_calendar, EPERM}});
}

// On one processor: the least urgent task holds the lock, the most urgent one waits for it, and one between them would run
// for half a second. True if the most urgent one was served before that.
template <class Lock>
bool is_served(Lock& lock, bool& is_permitted) {
    MonotonicClock clock;
    std::atomic<bool> is_held{false};
    std::atomic<bool> is_urgent_served{false};
    std::atomic<bool> was_in_time{false};
    std::atomic<bool> refused{false};
    std::atomic<bool> asks{false};
    std::atomic<bool> arrives{false};
    const auto wait_for = [&](std::atomic<bool>& flag) {
        const std::int64_t end_ns = clock.now_ns() + 2000 * ms;
        while (!flag && clock.now_ns() < end_ns) {
        }
    };
    // Urgent at first, so that no other program comes between, and then on the one processor.
    const auto begin = [&](int priority, std::atomic<bool>& tell) {
        refused = become_realtime({.priority = priority}).priority != Grant::granted || refused;
        tell = true;
        refused = become_realtime({.processor = 0}).processor != Grant::granted || refused;
    };
    std::thread least{[&] {
        Watchdog watchdog{5000 * ms};
        ASSERT_TRUE(lock.acquire(0, watchdog));
        begin(1, is_held);
        wait_for(asks);
        wait_for(arrives);
        // Long enough for both to be there; what is done from then on is done by inheritance, or not at all.
        const std::int64_t end_ns = clock.now_ns() + 20 * ms;
        while (clock.now_ns() < end_ns) {
        }
        lock.release();
    }};
    while (!is_held) {
        std::this_thread::yield();
    }
    std::thread most{[&] {
        begin(3, asks);
        Watchdog watchdog{5000 * ms};
        ASSERT_TRUE(lock.acquire(1, watchdog));
        is_urgent_served = true;
        lock.release();
    }};
    while (!asks) {
        std::this_thread::yield();
    }
    std::thread between{[&] {
        begin(2, arrives);
        const std::int64_t end_ns = clock.now_ns() + 500 * ms;
        while (!is_urgent_served && clock.now_ns() < end_ns) {
        }
        was_in_time = is_urgent_served.load();
    }};
    least.join();
    most.join();
    between.join();
    is_permitted = !refused;
    return was_in_time;
}

TEST(PairLock, PriorityIsInherited) {
    MonotonicClock clock;
    PairLock<MonotonicClock> lock{clock};
    bool is_permitted = false;
    const bool served = is_served(lock, is_permitted);
    if (!is_permitted) {
        // Without priorities there is nothing to invert: all that can be seen is that everybody was served.
        std::puts("no permission for SCHED_FIFO: inheritance is not looked at");
        return;
    }
    EXPECT_TRUE(served);
    // The judge is no use if it finds the same of a lock without inheritance.
    Semaphore<MonotonicClock> without{clock};
    EXPECT_FALSE(is_served(without, is_permitted));
}

}  // namespace
}  // namespace groundstate
