// What the channels tell their observers, in which order, and the faults that an observer puts in.
#include "groundstate/observer.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <utility>

#include "groundstate/locked_buffer.hpp"
#include "groundstate/message_queue.hpp"
#include "groundstate/virtual_clock.hpp"
#include "groundstate/wait_free_buffer.hpp"

namespace groundstate {
namespace {

// Writes down all that it is told. What it says of faults and of offers is set from outside.
struct Told {
    std::string text{};
    Fault seeded = Fault::none;
    bool offers = false;

    std::string taken() { return std::exchange(text, {}); }
};

class Scribe {
  public:
    explicit Scribe(Told& told) : told_{&told} {}

    void asks(Side side) noexcept { tell("asks", of(side)); }
    void enters(Side side) noexcept { tell("enters", of(side)); }
    void gives_up(Side side) noexcept { tell("gives up", of(side)); }
    void releases(Side side) noexcept { tell("releases", of(side)); }
    void swaps(std::size_t read, std::size_t write, std::uint64_t number) noexcept { tell("swaps", read, write, number); }
    void managed() noexcept { tell("managed"); }
    void writes(std::size_t array, std::uint64_t number) noexcept { tell("writes", array, number); }
    bool offers() const noexcept { return told_->offers; }
    void reads(std::size_t array, std::uint64_t number, bool fresh) noexcept { tell("reads", array, number, fresh); }
    void looks() noexcept { tell("looks"); }
    void sends(std::uint64_t number) noexcept { tell("sends", number); }
    void refuses() noexcept { tell("refuses"); }
    void takes(std::uint64_t number) noexcept { tell("takes", number); }
    void stores(std::uint64_t number) noexcept { tell("stores", number); }
    void loads(std::uint64_t number, bool fresh) noexcept { tell("loads", number, fresh); }
    bool seeded(Fault fault) const noexcept { return told_->seeded == fault; }

  private:
    static std::string of(Side side) { return side == Side::producer ? "producer" : "consumer"; }
    static std::string of(std::uint64_t number) { return std::to_string(number); }
    static std::string of(const std::string& word) { return word; }

    template <class... What>
    void tell(const char* action, const What&... what) noexcept {
        told_->text += action;
        ((told_->text += ' ' + of(what)), ...);
        told_->text += ", ";
    }

    Told* told_;
};

template <class Buffer>
struct Observed {
    explicit Observed(std::size_t threads = 0) : clock{threads} {}

    VirtualClock clock;
    Told told{};
    Buffer buffer{clock, Scribe{told}};
    Watchdog watchdog{50};

    bool write(int value) {
        auto writing = buffer.write(watchdog);
        *writing = value;
        return writing.publish();
    }

    // 0: nothing to read.
    int read() {
        watchdog.restart();
        const auto reading = buffer.read(watchdog);
        return reading ? *reading : 0;
    }
};

template <Master master, std::size_t N>
using Locked = Observed<LockedBuffer<int, N, master, VirtualClock, Scribe>>;
template <std::size_t N>
using WaitFree = Observed<WaitFreeBuffer<int, N, VirtualClock, Scribe>>;

TEST(Observer, HearsAllOfAMasterThatWrites) {
    Locked<Master::writer, 3> pair;
    EXPECT_EQ(pair.read(), 0);
    EXPECT_EQ(pair.told.taken(), "asks consumer, enters consumer, reads 2 0 0, releases consumer, ");
    pair.write(1);
    EXPECT_EQ(pair.told.taken(), "writes 0 1, asks producer, enters producer, swaps 0 1 1, managed, releases producer, ");
    EXPECT_EQ(pair.read(), 1);
    EXPECT_EQ(pair.told.taken(), "asks consumer, enters consumer, reads 0 1 1, releases consumer, ");
    pair.write(2);
    EXPECT_EQ(pair.told.taken(), "writes 1 2, asks producer, enters producer, swaps 1 2 2, managed, releases producer, ");
    {
        const auto reading = pair.buffer.read(pair.watchdog);  // the slave has the lock
        pair.told.taken();
        EXPECT_FALSE(pair.write(3));
        EXPECT_EQ(pair.told.taken(), "writes 2 3, asks producer, gives up producer, ");
    }
    EXPECT_EQ(pair.told.taken(), "releases consumer, ");
    { (void)pair.buffer.write(pair.watchdog); }
    EXPECT_EQ(pair.told.taken(), "writes 2 4, ") << "the number that it would have";
}

TEST(Observer, HearsAllOfAMasterThatReads) {
    Locked<Master::reader, 2> pair;
    EXPECT_EQ(pair.read(), 0);
    EXPECT_EQ(pair.told.taken(), "asks consumer, enters consumer, managed, releases consumer, reads 1 0 0, ");
    pair.write(1);
    EXPECT_EQ(pair.told.taken(), "asks producer, enters producer, writes 0 1, releases producer, ");
    EXPECT_EQ(pair.read(), 1);
    EXPECT_EQ(pair.told.taken(), "asks consumer, enters consumer, swaps 0 1 1, managed, releases consumer, reads 0 1 1, ");
    {
        const auto writing = pair.buffer.write(pair.watchdog);
        EXPECT_EQ(pair.told.taken(), "asks producer, enters producer, writes 1 2, ");
        EXPECT_EQ(pair.read(), 1);
        EXPECT_EQ(pair.told.taken(), "asks consumer, gives up consumer, reads 0 1 0, ");
    }
    EXPECT_EQ(pair.told.taken(), "releases producer, ");
}

// As in the models: a writing of a slave is awaited from its beginning.
TEST(Observer, MayLetAWritingBeAwaitedFromItsBeginning) {
    Locked<Master::reader, 2> pair;
    Signal signal{pair.clock};
    pair.buffer.wakes(signal);
    {
        const auto writing = pair.buffer.write(pair.watchdog);
        EXPECT_FALSE(pair.buffer.available());
        EXPECT_EQ(signal.count(), 0U);
    }
    pair.told.offers = true;
    {
        auto writing = pair.buffer.write(pair.watchdog);
        EXPECT_TRUE(pair.buffer.available());
        EXPECT_EQ(signal.count(), 1U);
    }
    EXPECT_FALSE(pair.buffer.available()) << "it was withdrawn";
    pair.write(1);
    EXPECT_EQ(pair.read(), 1);
    EXPECT_FALSE(pair.buffer.available());
}

TEST(Observer, HearsAllOfAWaitFreeBuffer) {
    WaitFree<3> pair;
    EXPECT_EQ(pair.read(), 0);
    EXPECT_EQ(pair.told.taken(), "loads 0 0, ");
    pair.write(1);
    EXPECT_EQ(pair.told.taken(), "stores 1, ");
    EXPECT_EQ(pair.read(), 1);
    EXPECT_EQ(pair.told.taken(), "loads 1 1, ");
    EXPECT_EQ(pair.read(), 1);
    EXPECT_EQ(pair.told.taken(), "loads 1 0, ");
    pair.write(2);
    pair.write(3);
    EXPECT_EQ(pair.read(), 3);
    EXPECT_EQ(pair.told.taken(), "stores 2, stores 3, loads 3 1, ");
}

TEST(Observer, HearsAllOfAQueue) {
    VirtualClock clock;
    Told told;
    MessageQueue<int, 1, VirtualClock, Scribe> queue{clock, Scribe{told}};
    Watchdog watchdog{10};
    EXPECT_EQ(queue.receive(), std::nullopt);
    EXPECT_EQ(told.taken(), "takes 0, ");
    EXPECT_TRUE(queue.try_send(7));
    EXPECT_FALSE(queue.try_send(8));
    EXPECT_FALSE(queue.send(9, watchdog));
    EXPECT_EQ(told.taken(), "looks, sends 1, looks, refuses, looks, refuses, ");
    EXPECT_EQ(queue.receive(), 7);
    EXPECT_TRUE(queue.send(10, watchdog));
    EXPECT_EQ(queue.receive(), 10);
    EXPECT_EQ(told.taken(), "takes 1, looks, sends 2, takes 2, ");
}

TEST(Seeded, AStaleReadingIsOfTheArrayBefore) {
    Locked<Master::writer, 3> pair;
    for (int value = 1; value <= 4; ++value) {
        pair.write(value);
        EXPECT_EQ(pair.read(), value);
        if (value > 1) {
            pair.told.seeded = Fault::stale_read;
            EXPECT_EQ(pair.read(), value - 1);
            pair.told.seeded = Fault::none;
        }
    }
    WaitFree<3> other;
    other.write(1);
    EXPECT_EQ(other.read(), 1);
    other.write(2);
    other.told.seeded = Fault::stale_read;
    EXPECT_EQ(other.read(), 1);
    other.told.seeded = Fault::none;
    EXPECT_EQ(other.read(), 2);
}

TEST(Seeded, IndexesThatAreNotSwappedHandNothingOver) {
    Locked<Master::writer, 2> writer;
    Locked<Master::reader, 2> reader;
    WaitFree<3> other;
    for (const bool seeded : {true, false}) {
        for (Told* told : {&writer.told, &reader.told, &other.told}) {
            told->seeded = seeded ? Fault::index_not_swapped : Fault::none;
        }
        EXPECT_TRUE(writer.write(1));
        EXPECT_TRUE(reader.write(1));
        EXPECT_TRUE(other.write(1)) << "what the program is told is no part of the fault";
        EXPECT_EQ(writer.read(), seeded ? 0 : 1);
        EXPECT_EQ(reader.read(), seeded ? 0 : 1);
        EXPECT_EQ(other.read(), seeded ? 0 : 1);
        EXPECT_EQ(other.buffer.account().written, seeded ? 1 : 2);
    }
}

TEST(Seeded, ALockThatIsNotTakenKeepsNobodyOut) {
    Locked<Master::writer, 2> pair;
    pair.told.seeded = Fault::lock_not_taken;
    pair.write(1);
    {
        const auto reading = pair.buffer.read(pair.watchdog);
        EXPECT_EQ(*reading, 1);
        pair.write(2);
        EXPECT_EQ(pair.buffer.account().handed_over, 2) << "while the slave reads";
    }
    EXPECT_EQ(pair.clock.now_ns(), 0);
    pair.told.seeded = Fault::none;
    EXPECT_EQ(pair.read(), 2) << "nothing was released that was not taken";
}

// The slave has the lock for more than a hundred years.
TEST(Seeded, AWatchdogThatIsIgnoredBoundsNoWait) {
    constexpr std::int64_t end_ns = 4'000'000'000'000'000'000;
    Locked<Master::reader, 2> pair{2};
    pair.told.seeded = Fault::watchdog_ignored;
    std::thread camera{[&] {
        pair.clock.enter(0);
        Watchdog watchdog{0};
        auto writing = pair.buffer.write(watchdog);
        *writing = 1;
        pair.clock.sleep_until_ns(end_ns);
        writing.publish();
        pair.clock.leave();
    }};
    pair.clock.enter(1);
    pair.clock.sleep_until_ns(10);
    EXPECT_EQ(pair.read(), 1);
    EXPECT_EQ(pair.clock.now_ns(), end_ns);
    pair.clock.leave();
    camera.join();
}

}  // namespace
}  // namespace groundstate
