// The message queue: order, refusal when full, waiting for room, waking.
#include "groundstate/message_queue.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "groundstate/virtual_clock.hpp"

namespace groundstate {
namespace {

TEST(MessageQueue, KeepsEveryMessageInItsOrder) {
    VirtualClock clock;
    MessageQueue<int, 3, VirtualClock> queue{clock};
    for (int round = 0; round < 10; ++round) {
        EXPECT_TRUE(queue.try_send(round));
        EXPECT_TRUE(queue.try_send(-round));
        EXPECT_EQ(queue.receive(), round);
        EXPECT_EQ(queue.receive(), -round);
        EXPECT_EQ(queue.receive(), std::nullopt);
    }
}

TEST(MessageQueue, RefusesAndCountsWhatItHasNoRoomFor) {
    VirtualClock clock;
    MessageQueue<int, 2, VirtualClock> queue{clock};
    EXPECT_TRUE(queue.try_send(1));
    EXPECT_TRUE(queue.try_send(2));
    EXPECT_FALSE(queue.try_send(3));
    clock.sleep_until_ns(10);
    Watchdog watchdog{40};
    EXPECT_FALSE(queue.send(4, watchdog));
    EXPECT_EQ(clock.now_ns(), 50);
    EXPECT_EQ(watchdog.total_wait_ns(), 40);
    EXPECT_EQ(watchdog.skipped(), 1);
    EXPECT_EQ(queue.refused(), 2);
    EXPECT_EQ(queue.receive(), 1);
    EXPECT_EQ(queue.receive(), 2);
    EXPECT_EQ(queue.receive(), std::nullopt) << "nothing was overwritten";
}

TEST(MessageQueue, ASenderWaitsForRoomAndIsWoken) {
    VirtualClock clock{2};
    MessageQueue<int, 2, VirtualClock> queue{clock};
    std::vector<int> received;
    std::thread sender{[&] {
        clock.enter(0);
        Watchdog watchdog{1'000};
        for (int message = 0; message < 6; ++message) {
            EXPECT_TRUE(queue.send(message, watchdog));
        }
        EXPECT_EQ(clock.now_ns(), 40) << "room for the last comes with the fourth receiving";
        clock.leave();
    }};
    std::thread receiver{[&] {
        clock.enter(1);
        while (received.size() < 6) {
            clock.sleep_until_ns(clock.now_ns() + 10);
            if (const auto message = queue.receive()) {
                received.push_back(*message);
            }
        }
        clock.leave();
    }};
    sender.join();
    receiver.join();
    EXPECT_EQ(received, (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

// Both ask again and again, so that nothing but the queue orders what they do.
TEST(MessageQueue, ASlotBelongsToOneOfThemAtATime) {
    MonotonicClock clock;
    MessageQueue<int, 1, MonotonicClock> queue{clock};
    std::thread sender{[&] {
        for (int message = 1; message <= 100; ++message) {
            while (!queue.try_send(message)) {
                std::this_thread::yield();
            }
        }
    }};
    for (int message = 1; message <= 100; ++message) {
        std::optional<int> received;
        while (!(received = queue.receive())) {
            std::this_thread::yield();
        }
        ASSERT_EQ(*received, message);
    }
    sender.join();
}

TEST(MessageQueue, TakesWhatCannotBeCopied) {
    VirtualClock clock;
    MessageQueue<std::unique_ptr<int>, 1, VirtualClock> queue{clock};
    Watchdog watchdog{0};
    EXPECT_TRUE(queue.try_send(std::make_unique<int>(3)));
    auto refused = std::make_unique<int>(4);
    EXPECT_FALSE(queue.try_send(std::move(refused)));
    EXPECT_FALSE(queue.send(std::move(refused), watchdog));
    ASSERT_NE(refused, nullptr) << "a refused message stays with its sender";
    EXPECT_EQ(**queue.receive(), 3);
    EXPECT_TRUE(queue.send(std::move(refused), watchdog));
    EXPECT_EQ(**queue.receive(), 4);
}

}  // namespace
}  // namespace groundstate
