// What the bounds of a chart count: each at its edges, the numbers of a run's end, and data followed from thread to thread.
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "groundstate/bounds.hpp"

namespace groundstate {
namespace {

TEST(Bounds, BothEndsOfAnIntervalAreWithin) {
    Bound look{{.kind = Bounded::elaboration, .what = "look", .limit = "3..5 ms", .least = 3, .most = 5}, 10};
    for (const std::int64_t length_ns : {30, 50, 29, 51, 40}) {
        look.saw(length_ns);
    }
    const BoundAccount account = look.account();
    EXPECT_EQ(account.seen, 5);
    EXPECT_EQ(account.below, 1);
    EXPECT_EQ(account.beyond, 1);
    EXPECT_EQ(account.outside(), 2);
    EXPECT_EQ(account.greatest, 51);
    EXPECT_TRUE(account.is_time);
}

TEST(Bounds, TheTimeUntilSomethingNewCountsFromTheFirstReadingOn) {
    Bound reading{{.kind = Bounded::reading, .most = 4}, 10};
    reading.saw_new(1000);
    EXPECT_EQ(reading.account().seen, 0);
    reading.saw_new(1040);
    reading.saw_new(1081);
    EXPECT_EQ(reading.account().seen, 2);
    EXPECT_EQ(reading.account().beyond, 1);
    reading.end(1121);
    EXPECT_EQ(reading.account().seen, 2) << "it still waits, and not for too long";
}

TEST(Bounds, ATimeThatStillRunsAtTheEndIsTooLong) {
    Bound reading{{.kind = Bounded::reading, .most = 4}, 10};
    reading.end(5000);
    EXPECT_EQ(reading.account().seen, 0) << "nothing new ever came";
    reading.saw_new(100);
    reading.end(141);
    EXPECT_EQ(reading.account().beyond, 1);
    EXPECT_EQ(reading.account().greatest, 41);
}

TEST(Bounds, OnlyALateCycleIsOneTooMany) {
    // As library/patterns/MissedDeadlines.asm counts.
    Bound misses{{.kind = Bounded::misses, .most = 1, .cycles = 3}, 10};
    std::vector<std::int64_t> beyond;
    for (const bool is_late : {true, false, true, false, false, true, true, true}) {
        misses.saw_cycle(is_late);
        beyond.push_back(misses.account().beyond);
    }
    EXPECT_EQ(beyond, (std::vector<std::int64_t>{0, 0, 1, 1, 1, 1, 2, 3}));
    EXPECT_EQ(misses.account().greatest, 3);
    EXPECT_EQ(misses.account().seen, 8);
    EXPECT_FALSE(misses.account().is_time);
}

// From task 0 over the channel 7 to task 1, which decides in its phase 5; task 0 decides in its phase 2.
WayPlan over_one_channel() {
    return {.bound = {.kind = Bounded::age, .task = 1, .most = 10}, .first = 0,
            .hops = {{.channel = 7, .writer = 0, .reader = 1, .decided = 2}}, .decided = 5};
}

TEST(Ways, AnAgeIsThatOfWhatWasReadBeforeTheDecision) {
    Way way{over_one_channel(), 10};
    const auto decides = [&](std::int64_t done_ns) {
        way.ends_phase(1, 5);
        way.ends_cycle(1, done_ns);
    };
    decides(90);
    EXPECT_EQ(way.bound().account().seen, 0) << "no datum has come yet";
    way.begins(0, 100);
    way.ends_phase(0, 2);
    way.begins(1, 105);
    way.writes(7, 1);
    way.writes(8, 1);
    way.reads(8, 1);
    decides(150);
    EXPECT_EQ(way.bound().account().seen, 0) << "it was not read";
    way.reads(7, 1);
    decides(200);
    EXPECT_EQ(way.bound().account().greatest, 100);
    EXPECT_EQ(way.bound().account().beyond, 0);
    way.reads(7, 1);
    decides(201);
    EXPECT_EQ(way.bound().account().greatest, 101) << "the same datum, later";
    EXPECT_EQ(way.bound().account().beyond, 1);
    // What is read after the decision is for the next one.
    way.begins(0, 210);
    way.ends_phase(0, 2);
    way.writes(7, 2);
    way.ends_phase(1, 5);
    way.reads(7, 2);
    way.ends_cycle(1, 230);
    EXPECT_EQ(way.bound().account().greatest, 130);
    decides(240);
    EXPECT_EQ(way.bound().account().seen, 4);
    EXPECT_EQ(way.bound().account().beyond, 2);
}

TEST(Ways, ATaskThatDecidesNothingTakesWhatItHasRead) {
    Way way{{.bound = {.kind = Bounded::age, .task = 2, .most = 10}, .first = 0,
             .hops = {{.channel = 3, .writer = 0, .reader = 1}, {.channel = 4, .writer = 1, .reader = 2}}}, 1};
    way.begins(0, 10);
    way.writes(3, 1);
    way.writes(4, 1);
    way.reads(4, 1);
    way.ends_cycle(2, 15);
    EXPECT_EQ(way.bound().account().seen, 0) << "what came rests on nothing";
    way.reads(3, 1);
    way.writes(4, 2);
    way.reads(4, 2);
    way.ends_cycle(2, 19);
    EXPECT_EQ(way.bound().account().greatest, 9);
}

TEST(Origins, AreKnownUntilFarNewerOnesCome) {
    const auto origins = std::make_unique<Origins>();
    EXPECT_EQ(origins->get(0), never_ns);
    EXPECT_EQ(origins->get(1), never_ns);
    for (std::uint64_t number = 1; number <= 1025; ++number) {
        origins->set(number, static_cast<std::int64_t>(number) * 10);
    }
    EXPECT_EQ(origins->get(1), never_ns);
    EXPECT_EQ(origins->get(2), 20);
    EXPECT_EQ(origins->get(1025), 10250);
}

TEST(Origins, AReaderNeverGetsThatOfAnotherDatum) {
    const auto origins = std::make_unique<Origins>();
    constexpr std::uint64_t last = 200'000;
    std::atomic<std::uint64_t> written{0};
    std::thread writer{[&] {
        for (std::uint64_t number = 1; number <= last; ++number) {
            origins->set(number, static_cast<std::int64_t>(number) * 3);
            written.store(number, std::memory_order_release);
        }
    }};
    std::int64_t wrong = 0;
    std::int64_t known = 0;
    for (std::uint64_t number = 0; number < last;) {
        number = written.load(std::memory_order_acquire);
        const std::int64_t origin_ns = origins->get(number);
        if (origin_ns != never_ns) {
            ++known;
            wrong += origin_ns == static_cast<std::int64_t>(number) * 3 ? 0 : 1;
        }
    }
    writer.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(known, 0);
}

}  // namespace
}  // namespace groundstate
