// The lock between two tasks in real time: one at a time, nobody beyond his watchdog, no inversion of priorities.
#include "groundstate/pair_lock.hpp"

#include <gtest/gtest.h>

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
        Watchdog some{5 * ms};
        const std::int64_t before_ns = clock.now_ns();
        EXPECT_FALSE(lock.acquire(1, some));
        EXPECT_GE(clock.now_ns() - before_ns, 5 * ms);
        EXPECT_LE(some.left_ns(), 0);
        EXPECT_EQ(none.skipped() + some.skipped(), 2);
    }};
    other.join();
    EXPECT_FALSE(lock.acquire(0, holder)) << "who holds it does not wait for himself";
    lock.release();
    Watchdog again{ms};
    EXPECT_TRUE(lock.acquire(1, again));
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
