// Virtual time: it jumps, it keeps the order of ranks, and a run is the same each time.
#include "groundstate/virtual_clock.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace groundstate {
namespace {

TEST(VirtualClock, JumpsToTheInstantSleptUntil) {
    VirtualClock clock;
    clock.sleep_until_ns(5'000'000'000);
    EXPECT_EQ(clock.now_ns(), 5'000'000'000);
    clock.sleep_until_ns(1);
    EXPECT_EQ(clock.now_ns(), 5'000'000'000) << "time never goes back";
}

TEST(VirtualClock, WaitsForAWordUntilTheInstant) {
    VirtualClock clock;
    Word word{7};
    clock.wait_while(word, 7, 100);
    EXPECT_EQ(clock.now_ns(), 100);
    clock.wait_while(word, 6, 200);
    EXPECT_EQ(clock.now_ns(), 100) << "the word was another one already";
}

// Two sleepers and one who waits for the word that the second of them changes.
std::string a_run() {
    VirtualClock clock{3};
    Word word{0};
    std::string log;
    auto sleeper = [&](int rank, std::int64_t period_ns) {
        clock.enter(rank);
        for (std::int64_t due_ns = 0; due_ns <= 12; due_ns += period_ns) {
            clock.sleep_until_ns(due_ns);
            log += std::to_string(clock.now_ns()) + static_cast<char>('a' + rank) + ' ';
        }
        if (rank == 1) {
            word.store(1);
            clock.wake(word);
        }
        clock.leave();
    };
    std::thread second{sleeper, 1, 4};
    std::thread first{sleeper, 0, 6};
    std::thread waiter{[&] {
        clock.enter(2);
        clock.wait_while(word, 0, never_ns);
        log += "woken at " + std::to_string(clock.now_ns());
        clock.leave();
    }};
    first.join();
    second.join();
    waiter.join();
    return log;
}

TEST(VirtualClock, EveryRunIsTheSame) {
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(a_run(), "0a 0b 4b 6a 8b 12a 12b woken at 12");
    }
}

// One thread computes for ever, as it seems; without it the others go on.
TEST(VirtualClock, GoesOnWithoutWhoeverWasEvicted) {
    VirtualClock clock{2};
    std::atomic<bool> begun{false};
    std::atomic<bool> computes{true};
    std::thread first{[&] {
        clock.enter(0);
        begun = true;
        while (computes.load()) {
            std::this_thread::yield();
        }
        clock.leave();
    }};
    std::atomic<std::int64_t> slept_ns{0};
    std::thread second{[&] {
        clock.enter(1);
        clock.sleep_until_ns(5);
        slept_ns = clock.now_ns();
        clock.leave();
    }};
    // Evicted before it sees that it has the turn, it would wait for ever.
    while (!begun.load()) {
        std::this_thread::yield();
    }
    EXPECT_EQ(clock.evict(0), 0);
    second.join();
    EXPECT_EQ(slept_ns, 5);
    EXPECT_FALSE(clock.evict(0)) << "nobody has the turn";
    computes = false;
    first.join();
}

}  // namespace
}  // namespace groundstate
