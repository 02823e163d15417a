// What holds of both forms of the swinging buffer and every number of arrays: newest, fresh, accounted, in place.
#include "groundstate/swinging_buffer.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "groundstate/locked_buffer.hpp"
#include "groundstate/virtual_clock.hpp"
#include "groundstate/wait_free_buffer.hpp"

namespace groundstate {
namespace {

template <class B>
class SwingingBufferTest : public testing::Test {
  protected:
    VirtualClock clock;
    B buffer{clock};
    Watchdog watchdog{1'000};

    void write(int value) {
        auto writing = buffer.write(watchdog);
        ASSERT_TRUE(writing);
        *writing = value;
        EXPECT_TRUE(writing.publish());
    }

    // What a reading gives, and whether it is new.
    std::pair<int, bool> read() {
        const auto reading = buffer.read(watchdog);
        return reading ? std::pair{*reading, reading.fresh()} : std::pair{-1, reading.fresh()};
    }

    // The identities of `sb_accounted`, and which data are not yet looked at.
    void expect_accounted(std::int64_t outstanding) {
        const Account account = buffer.account();
        EXPECT_GE(account.pending(), 0);
        EXPECT_LE(account.pending(), 1);
        EXPECT_EQ(account.handed_over, account.read + account.unread + outstanding - account.pending());
    }
};

using Buffers = testing::Types<
    LockedBuffer<int, 2, Master::writer, VirtualClock>, LockedBuffer<int, 2, Master::reader, VirtualClock>,
    LockedBuffer<int, 3, Master::writer, VirtualClock>, LockedBuffer<int, 5, Master::reader, VirtualClock>,
    WaitFreeBuffer<int, 3, VirtualClock>, WaitFreeBuffer<int, 4, VirtualClock>, WaitFreeBuffer<int, 7, VirtualClock>>;
TYPED_TEST_SUITE(SwingingBufferTest, Buffers);

TEST(Account, IsOfNothingAtFirst) {
    const Account account;
    for (const std::int64_t count : {account.written, account.handed_over, account.overwritten, account.read, account.unread,
                                     account.dropped, account.withdrawn, account.missed, account.pending()}) {
        EXPECT_EQ(count, 0);
    }
}

TEST(Array, HoldsNothingAtFirst) {
    const Array<int> array;
    EXPECT_EQ(array.datum, 0);
    EXPECT_EQ(array.sequence, 0U);
    EXPECT_EQ(array.stamp_ns, 0);
}

TYPED_TEST(SwingingBufferTest, IsASwingingBuffer) { static_assert(SwingingBuffer<TypeParam>); }

TYPED_TEST(SwingingBufferTest, GivesNothingBeforeTheFirstHandOver) {
    EXPECT_FALSE(this->buffer.available());
    EXPECT_EQ(this->read(), (std::pair{-1, false}));
}

TYPED_TEST(SwingingBufferTest, GivesTheNewestOnceAsFresh) {
    for (int value = 1; value <= 20; ++value) {
        this->write(value);
        EXPECT_TRUE(this->buffer.available());
        EXPECT_EQ(this->read(), (std::pair{value, true}));
        EXPECT_FALSE(this->buffer.available());
        EXPECT_EQ(this->read(), (std::pair{value, false})) << "never an older one, as after a swap back";
        this->expect_accounted(0);
    }
}

TYPED_TEST(SwingingBufferTest, CountsWhatWasNeverRead) {
    for (int value = 1; value <= 10; ++value) {
        this->write(value);
        this->expect_accounted(1);
    }
    EXPECT_EQ(this->read(), (std::pair{10, true}));
    const Account account = this->buffer.account();
    EXPECT_EQ(account.written, 10);
    EXPECT_EQ(account.read, 1);
    EXPECT_EQ(account.overwritten + account.unread, 9);
}

TYPED_TEST(SwingingBufferTest, NumbersAndStampsEachDatum) {
    for (std::uint64_t number = 1; number <= 9; ++number) {
        this->clock.sleep_until_ns(static_cast<std::int64_t>(number) * 100);
        this->write(0);
        if (number % 3 == 0) {
            const auto reading = this->buffer.read(this->watchdog);
            EXPECT_EQ(reading.sequence(), number);
            EXPECT_EQ(reading.stamp_ns(), this->clock.now_ns());
        }
    }
    {
        auto writing = this->buffer.write(this->watchdog);
        writing.publish_at(7);
    }
    EXPECT_EQ(this->buffer.read(this->watchdog).stamp_ns(), 7);
}

TYPED_TEST(SwingingBufferTest, AWithdrawnDatumIsNeverSeen) {
    this->write(1);
    EXPECT_EQ(this->read(), (std::pair{1, true}));
    {
        auto writing = this->buffer.write(this->watchdog);
        *writing = 2;
    }
    EXPECT_FALSE(this->buffer.available());
    EXPECT_EQ(this->read(), (std::pair{1, false}));
    EXPECT_EQ(this->buffer.account().withdrawn, 1);
    this->write(3);
    {
        auto writing = this->buffer.write(this->watchdog);
        *writing = 4;
    }
    // Where a writing begins on an array that is pending (a slave's), the pending datum is gone, and counted.
    EXPECT_EQ(this->buffer.available(), this->buffer.account().overwritten == 0);
    this->expect_accounted(this->buffer.available() ? 1 : 0);
}

TYPED_TEST(SwingingBufferTest, WorksInPlace) {
    std::set<const int*> arrays;
    this->buffer.prepare([&](int& datum) { arrays.insert(&datum); });
    for (int value = 1; value <= 20; ++value) {
        const int* written = nullptr;
        {
            auto writing = this->buffer.write(this->watchdog);
            written = &*writing;
            writing.publish();
        }
        const auto reading = this->buffer.read(this->watchdog);
        EXPECT_EQ(&*reading, written);
        EXPECT_TRUE(arrays.contains(written));
    }
}

// Of the buffer's arrays, the data that stay where they are for a reader: not those that are, or may be, written.
template <class T, std::size_t N, Master master, class C>
constexpr std::size_t kept(const LockedBuffer<T, N, master, C>&) { return N - 1; }
template <class T, std::size_t N, class C>
constexpr std::size_t kept(const WaitFreeBuffer<T, N, C>&) { return N - 2; }

TYPED_TEST(SwingingBufferTest, KeepsEarlierData) {
    for (int value = 1; value <= 20; ++value) {
        this->write(value);
        const auto reading = this->buffer.read(this->watchdog);
        for (std::size_t back = 0; back < 10; ++back) {
            const int* earlier = reading.previous(back);
            ASSERT_EQ(earlier != nullptr, back < kept(this->buffer) && static_cast<int>(back) < value) << back;
            if (earlier != nullptr) {
                EXPECT_EQ(*earlier, value - static_cast<int>(back));
            }
        }
    }
}

TYPED_TEST(SwingingBufferTest, RaisesTheConsumersSignal) {
    Signal signal{this->clock};
    this->buffer.wakes(signal);
    const std::uint32_t before = signal.count();
    this->write(1);
    EXPECT_EQ(signal.count(), before + 1);
}

TYPED_TEST(SwingingBufferTest, OneAccessAtATimeOnEachSide) {
    this->write(1);
    {
        const auto writing = this->buffer.write(this->watchdog);
        EXPECT_DEATH((void)this->buffer.write(this->watchdog), "two accesses at once");
    }
    {
        const auto reading = this->buffer.read(this->watchdog);
        EXPECT_DEATH((void)this->buffer.read(this->watchdog), "two accesses at once");
    }
    this->write(2);
    EXPECT_EQ(this->read(), (std::pair{2, true}));
}

}  // namespace
}  // namespace groundstate
