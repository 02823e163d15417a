// The paper's form: who holds the lock when, and what happens when the watchdog ends first. As in the scenarios of
// library/patterns/tests: PairWatchdogMaster, PairWatchdogMasterWriting, PairWatchdogSlave.
#include "groundstate/locked_buffer.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "groundstate/virtual_clock.hpp"

namespace groundstate {
namespace {

template <Master master, std::size_t N = 2>
struct Pair {
    VirtualClock clock{};
    LockedBuffer<int, N, master, VirtualClock> buffer{clock};
    Watchdog producer{50};
    Watchdog consumer{50};

    void write(int value) {
        auto writing = buffer.write(producer);
        *writing = value;
        writing.publish();
    }
};

TEST(LockedBuffer, AMasterReadsTheOldArrayWhenItsWatchdogEnds) {
    Pair<Master::reader> pair;
    pair.write(1);
    EXPECT_EQ(*pair.buffer.read(pair.consumer), 1);
    auto writing = pair.buffer.write(pair.producer);  // the slave has the lock
    *writing = 2;
    {
        const auto reading = pair.buffer.read(pair.consumer);
        ASSERT_TRUE(reading);
        EXPECT_EQ(*reading, 1);
        EXPECT_FALSE(reading.fresh());
        EXPECT_EQ(pair.clock.now_ns(), 50);
    }
    EXPECT_EQ(pair.buffer.account().missed, 1);
    EXPECT_EQ(pair.consumer.skipped(), 1);
    writing.publish();
    pair.consumer.restart();
    EXPECT_EQ(*pair.buffer.read(pair.consumer), 2);
}

TEST(LockedBuffer, AMasterPreparesItsNextDatumInPlace) {
    Pair<Master::writer> pair;
    pair.write(1);
    pair.buffer.own() = 2;
    EXPECT_EQ(*pair.buffer.read(pair.consumer), 1) << "what was not published is not handed over";
    auto writing = pair.buffer.write(pair.producer);
    EXPECT_EQ(*writing, 2);
    writing.publish();
    const auto reading = pair.buffer.read(pair.consumer);
    EXPECT_EQ(*reading, 2);
    EXPECT_EQ(reading.sequence(), 2U);
}

TEST(LockedBuffer, AMastersDatumStaysPendingWhenItsWatchdogEnds) {
    Pair<Master::writer> pair;
    pair.write(1);
    {
        const auto reading = pair.buffer.read(pair.consumer);  // the slave has the lock
        auto writing = pair.buffer.write(pair.producer);
        *writing = 2;
        EXPECT_FALSE(writing.publish());
        EXPECT_EQ(*reading, 1) << "what is being read does not change";
    }
    EXPECT_EQ(pair.buffer.account().pending(), 1);
    EXPECT_EQ(pair.producer.skipped(), 1);
    EXPECT_FALSE(pair.buffer.available());
    pair.producer.restart();
    pair.write(3);
    EXPECT_EQ(pair.buffer.account().overwritten, 1) << "lost, but not silently";
    EXPECT_EQ(*pair.buffer.read(pair.consumer), 3);
}

// Does something in the index section of the master, who holds the lock there.
struct Meanwhile : Unobserved {
    explicit Meanwhile(std::function<void()>& act) : act_{&act} {}
    void managed() noexcept {
        if (*act_) {
            std::exchange(*act_, nullptr)();
        }
    }
    std::function<void()>* act_;
};

TEST(LockedBuffer, ASlaveReaderLeavesTheReadingOut) {
    VirtualClock clock;
    std::function<void()> meanwhile;
    LockedBuffer<int, 2, Master::writer, VirtualClock, Meanwhile> buffer{clock, Meanwhile{meanwhile}};
    Watchdog producer{50};
    Watchdog hasty{0};
    meanwhile = [&] {
        const auto reading = buffer.read(hasty);
        EXPECT_FALSE(reading);
        EXPECT_FALSE(reading.attempted());
        EXPECT_FALSE(reading.fresh());
    };
    auto writing = buffer.write(producer);
    *writing = 1;
    EXPECT_TRUE(writing.publish());
    EXPECT_EQ(buffer.account().missed, 1);
    EXPECT_EQ(hasty.skipped(), 1);
    EXPECT_EQ(*buffer.read(hasty), 1);
}

TEST(LockedBuffer, ASlaveWriterDropsAndCounts) {
    VirtualClock clock;
    std::function<void()> meanwhile;
    LockedBuffer<int, 2, Master::reader, VirtualClock, Meanwhile> buffer{clock, Meanwhile{meanwhile}};
    Watchdog consumer{50};
    Watchdog hasty{0};
    meanwhile = [&] { EXPECT_FALSE(buffer.write(hasty)); };
    EXPECT_FALSE(buffer.read(consumer));
    EXPECT_EQ(hasty.skipped(), 1);
    EXPECT_EQ(buffer.account().dropped, 1);
    EXPECT_EQ(buffer.account().written, 0);
    EXPECT_TRUE(buffer.write(hasty));
}

// The camera writes for 30 of every 100 ns as a slave; the servoing asks in the middle of it, and waits for just 10.
TEST(LockedBuffer, AMasterWaitsForTheSlavesAccess) {
    VirtualClock clock{2};
    LockedBuffer<int, 2, Master::reader, VirtualClock> buffer{clock};
    std::thread camera{[&] {
        clock.enter(0);
        Watchdog watchdog{0};
        for (int image = 1; image <= 10; ++image) {
            clock.sleep_until_ns(image * 100);
            auto writing = buffer.write(watchdog);
            ASSERT_TRUE(writing);
            *writing = image;
            clock.sleep_until_ns(clock.now_ns() + 30);
            writing.publish();
        }
        clock.leave();
    }};
    std::thread servoing{[&] {
        clock.enter(1);
        Watchdog watchdog{20};
        for (int image = 1; image <= 10; ++image) {
            watchdog.restart();
            clock.sleep_until_ns(image * 100 + 20);
            const auto reading = buffer.read(watchdog);
            EXPECT_TRUE(reading.fresh());
            EXPECT_EQ(*reading, image);
            EXPECT_EQ(clock.now_ns(), image * 100 + 30);
        }
        EXPECT_EQ(watchdog.longest_wait_ns(), 10);
        clock.leave();
    }};
    camera.join();
    servoing.join();
    EXPECT_EQ(buffer.account().read, 10);
}

}  // namespace
}  // namespace groundstate
