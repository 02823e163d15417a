// The semaphore: permits, order of arrival, hand-over, and the watchdog.
#include "groundstate/semaphore.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "groundstate/virtual_clock.hpp"

namespace groundstate {
namespace {

TEST(Semaphore, GivesAsManyPermitsAsItHas) {
    VirtualClock clock;
    Semaphore semaphore{clock, 2};
    Watchdog never_waits{0};
    EXPECT_TRUE(semaphore.acquire(0, never_waits));
    EXPECT_TRUE(semaphore.acquire(1, never_waits));
    EXPECT_FALSE(semaphore.acquire(2, never_waits));
    EXPECT_EQ(never_waits.skipped(), 1);
    semaphore.release();
    EXPECT_TRUE(semaphore.acquire(2, never_waits));
}

TEST(Semaphore, WaitsExactlyAsLongAsTheWatchdogAllows) {
    VirtualClock clock;
    Semaphore semaphore{clock};
    Watchdog watchdog{300};
    ASSERT_TRUE(semaphore.acquire(0, watchdog));
    EXPECT_FALSE(semaphore.acquire(1, watchdog));
    EXPECT_EQ(clock.now_ns(), 300);
    EXPECT_EQ(watchdog.longest_wait_ns(), 300);
    EXPECT_FALSE(semaphore.acquire(1, watchdog)) << "the budget is the cycle's, not the wait's";
    EXPECT_EQ(clock.now_ns(), 300);
    watchdog.restart();
    EXPECT_FALSE(semaphore.acquire(1, watchdog));
    EXPECT_EQ(clock.now_ns(), 600);
    EXPECT_EQ(watchdog.skipped(), 3);
    semaphore.release();
    EXPECT_TRUE(semaphore.acquire(1, watchdog)) << "who gave up is no longer in line";
}

// Counts how often the time is read.
struct CountingClock : VirtualClock {
    std::int64_t now_ns() const noexcept {
        ++reads;
        return VirtualClock::now_ns();
    }
    mutable int reads = 0;
};

TEST(Semaphore, ReadsTheTimeOnlyToWait) {
    CountingClock clock;
    Semaphore semaphore{clock};
    Watchdog never_waits{0};
    EXPECT_TRUE(semaphore.acquire(0, never_waits));
    EXPECT_FALSE(semaphore.acquire(1, never_waits));
    EXPECT_EQ(clock.reads, 0);
    Watchdog least{1};
    EXPECT_FALSE(semaphore.acquire(1, least));
    EXPECT_GT(clock.reads, 0);
    EXPECT_EQ(clock.now_ns(), 1);
    EXPECT_EQ(least.total_wait_ns(), 1);
}

// Both ask again and again, so that nothing but the semaphore orders what they do.
TEST(Semaphore, WhatWasDoneWithThePermitIsSeenByTheNextHolder) {
    MonotonicClock clock;
    Semaphore semaphore{clock};
    int done = 0;
    const auto work = [&](int user) {
        Watchdog watchdog{0};
        for (int i = 0; i < 100; ++i) {
            while (!semaphore.acquire(user, watchdog)) {
                std::this_thread::yield();
            }
            ++done;
            semaphore.release();
            std::this_thread::yield();
        }
    };
    std::thread one{work, 0};
    std::thread other{work, 1};
    one.join();
    other.join();
    EXPECT_EQ(done, 200);
}

// The time of a user that waits until 10. When it asks for the second time, after its last look at the line, the other one releases.
// Nothing is ordered by that.
struct LateClock {
    std::int64_t now_ns() const noexcept {
        if (asked++ == 0) {
            return 0;
        }
        may_release.store(true, std::memory_order_relaxed);
        while (!is_released.load(std::memory_order_relaxed)) {
            std::this_thread::yield();
        }
        return 10;
    }
    void sleep_until_ns(std::int64_t) noexcept {}
    void wait_while(Word&, std::uint32_t, std::int64_t) noexcept {}
    void wake(Word&) noexcept {}
    void enter(int) noexcept {}
    void leave() noexcept {}

    mutable int asked = 0;
    mutable std::atomic<bool> may_release{false};
    std::atomic<bool> is_released{false};
};

TEST(Semaphore, WhoGivesUpAtTheMomentOfTheGrantHasThePermit) {
    LateClock clock;
    Semaphore semaphore{clock};
    std::atomic<bool> is_held{false};
    int handed = 0;
    std::thread holder{[&] {
        Watchdog watchdog{0};
        EXPECT_TRUE(semaphore.acquire(0, watchdog));
        is_held.store(true, std::memory_order_relaxed);
        while (!clock.may_release.load(std::memory_order_relaxed)) {
            std::this_thread::yield();
        }
        handed = 1;
        semaphore.release();
        clock.is_released.store(true, std::memory_order_relaxed);
    }};
    while (!is_held.load(std::memory_order_relaxed)) {
        std::this_thread::yield();
    }
    Watchdog watchdog{10};
    EXPECT_TRUE(semaphore.acquire(1, watchdog));
    EXPECT_EQ(handed, 1) << "what was done with the permit is seen";
    EXPECT_EQ(watchdog.skipped(), 0);
    EXPECT_EQ(watchdog.total_wait_ns(), 10);
    semaphore.release();
    holder.join();
    EXPECT_EQ(semaphore.permits(), 1);
}

TEST(Semaphore, CountsReleasesOfNobody) {
    VirtualClock clock;
    Semaphore semaphore{clock};
    semaphore.release();
    EXPECT_EQ(semaphore.illegal_releases(), 1);
    EXPECT_EQ(semaphore.permits(), 1);
}

// Six users ask one nanosecond after the other, while the first holds the permit; user 3 gives up in between.
TEST(Semaphore, ServesInTheOrderOfArrival) {
    VirtualClock clock{6};
    Semaphore semaphore{clock};
    std::string served;
    std::vector<std::thread> users;
    const std::array<int, 6> arrival{0, 4, 2, 3, 5, 1};
    for (std::size_t i = 0; i < arrival.size(); ++i) {
        users.emplace_back([&, i] {
            const int user = arrival[i];
            clock.enter(user);
            clock.sleep_until_ns(static_cast<std::int64_t>(i));
            Watchdog watchdog{user == 3 ? 50 : 10'000};
            if (semaphore.acquire(user, watchdog)) {
                served += std::to_string(user);
                clock.sleep_until_ns(clock.now_ns() + 100);
                semaphore.release();
                // Asking again at once does not overtake those in line.
                if (user == 0 && semaphore.acquire(user, watchdog)) {
                    served += 'o';
                    semaphore.release();
                }
            } else {
                served += '-';
            }
            clock.leave();
        });
    }
    for (std::thread& user : users) {
        user.join();
    }
    EXPECT_EQ(served, "0-4251o");
    EXPECT_EQ(semaphore.permits(), 1);
}

// User 0 has the permit and asks for another one when the six others stand in line. The last and the first of the seven give up.
TEST(Semaphore, ItsLineHasRoomForAllUsers) {
    VirtualClock clock{7};
    Semaphore semaphore{clock};
    std::string served;
    std::vector<std::thread> users;
    for (int user = 0; user < 7; ++user) {
        users.emplace_back([&, user] {
            clock.enter(user);
            clock.sleep_until_ns(user);
            Watchdog watchdog{user == 1 ? 50 : 10'000};
            if (user == 0) {
                EXPECT_TRUE(semaphore.acquire(user, watchdog));
                clock.sleep_until_ns(10);
                Watchdog once_more{20};
                EXPECT_FALSE(semaphore.acquire(user, once_more));
                clock.sleep_until_ns(100);
                semaphore.release();
            } else if (semaphore.acquire(user, watchdog)) {
                served += std::to_string(user);
                semaphore.release();
            } else {
                EXPECT_EQ(clock.now_ns(), 51);
                served += '-';
            }
            clock.leave();
        });
    }
    for (std::thread& user : users) {
        user.join();
    }
    EXPECT_EQ(served, "-23456");
    EXPECT_EQ(semaphore.permits(), 1);
    EXPECT_EQ(semaphore.illegal_releases(), 0);
    Watchdog watchdog{0};
    EXPECT_DEATH((void)semaphore.acquire(7, watchdog), "user < users");
}

}  // namespace
}  // namespace groundstate
