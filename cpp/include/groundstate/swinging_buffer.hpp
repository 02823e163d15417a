// The swinging buffer: several arrays between one producer and one consumer; each works on its own array, in place.
//
// Nothing is copied; only indexes change hands. Two forms have one interface:
//
//     LockedBuffer    the paper's (section V-B): the master swaps the indexes under a short lock, the slave holds the
//                     lock while it works on its array, each until its watchdog        locked_buffer.hpp
//     WaitFreeBuffer  one atomic exchange hands over the latest datum; no waiting      wait_free_buffer.hpp
//
// This file owns what they share: the account, the datum with its number and time, and the two accesses. What holds of
// both, as in library/patterns/SwingingBuffer.asm:
//   disjoint    producer and consumer never work on one array;
//   newest      a reading gives the newest datum handed over, never an older one than before, and says if it is new;
//   accounted   written = handed over + overwritten + pending, and handed over = read + unread + not yet looked at.
// Broadcast takes a buffer for each consumer.
#pragma once

#include <cassert>
#include <cstddef>
#include <utility>

#include "watchdog.hpp"

namespace groundstate {

/// The outcomes of all data. Each number is whole, and they agree while producer and consumer rest.
struct Account {
    std::int64_t written = 0;      ///< published by the producer
    std::int64_t handed_over = 0;  ///< made visible to the consumer
    std::int64_t overwritten = 0;  ///< replaced before it was handed over
    std::int64_t read = 0;         ///< seen by the consumer as new
    std::int64_t unread = 0;       ///< handed over, and replaced before it was read
    std::int64_t dropped = 0;      ///< not written at all: the producer's watchdog ended, or it was writing already
    std::int64_t withdrawn = 0;    ///< begun and not published
    std::int64_t missed = 0;       ///< readings not made, or of the old array: the watchdog ended, or it was reading already

    /// Published and not handed over: 0 or 1.
    std::int64_t pending() const noexcept { return written - handed_over - overwritten; }
};

/// A datum in its array. Number 0: nothing was ever written there.
template <class T>
struct alignas(64) Array {
    T datum{};
    std::uint64_t sequence = 0;
    std::int64_t stamp_ns = 0;
};

/// Whether one side of a buffer is at its array. Only that side's thread uses it.
class Access {
  public:
    /// Begins an access. A second one at the same time is a fault of the program: it would hand over, or take back, an
    /// array that the first one still uses. An assertion catches it; without assertions the second access is refused
    /// and counted.
    [[nodiscard]] bool begin() noexcept {
        assert(!open_ && "two accesses at once on one side of a swinging buffer: end the first one before");
        return !std::exchange(open_, true);
    }
    void end() noexcept { open_ = false; }

  private:
    bool open_ = false;
};

/// The producer's access to its array; false if the watchdog ended before the lock came. An access that ends without
/// publishing hands nothing over: the datum may be half written. One at a time.
template <class Buffer>
class [[nodiscard]] Writing {
  public:
    using Datum = typename Buffer::Datum;

    Writing(const Writing&) = delete;
    Writing& operator=(const Writing&) = delete;
    ~Writing() {
        if (buffer_ != nullptr) {
            buffer_->withdraw();
        }
    }

    explicit operator bool() const noexcept { return buffer_ != nullptr; }
    Datum& operator*() const noexcept { return *operator->(); }
    Datum* operator->() const noexcept {
        assert(buffer_ != nullptr && "nothing to write to: the watchdog ended, or it was published");
        return &array_->datum;
    }

    /// Ends the access and hands the datum over, stamped with the time. False if the watchdog ended before the swap:
    /// the datum stays pending for the next one. Contract: that of the form.
    bool publish() noexcept {
        assert(buffer_ != nullptr && "nothing to publish: the watchdog ended, or it was published");
        return publish_at(buffer_->clock().now_ns());
    }

    /// The same, with the time at which the datum was true: the camera's, not the computer's.
    bool publish_at(std::int64_t stamp_ns) noexcept {
        assert(buffer_ != nullptr && "nothing to publish: the watchdog ended, or it was published");
        return std::exchange(buffer_, nullptr)->hand_over(stamp_ns, *watchdog_);
    }

  private:
    friend Buffer;
    Writing() noexcept = default;
    Writing(Buffer& buffer, Array<Datum>& array, Watchdog& watchdog) noexcept
        : buffer_{&buffer}, array_{&array}, watchdog_{&watchdog} {}

    Buffer* buffer_ = nullptr;
    Array<Datum>* array_ = nullptr;
    Watchdog* watchdog_ = nullptr;
};

/// The consumer's access to its array; false if there is nothing to read: nothing was handed over yet, or a slave's
/// watchdog ended before the lock came. The access lasts until it is destroyed. One at a time.
template <class Buffer>
class [[nodiscard]] Reading {
  public:
    using Datum = typename Buffer::Datum;

    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;
    ~Reading() {
        if (buffer_ != nullptr) {
            buffer_->end_read();
        }
    }

    explicit operator bool() const noexcept { return array_ != nullptr; }
    /// There was an access, if only to find that nothing was handed over yet; false: the watchdog ended before the lock
    /// came.
    bool attempted() const noexcept { return buffer_ != nullptr; }
    const Datum& operator*() const noexcept { return *operator->(); }
    const Datum* operator->() const noexcept {
        assert(array_ != nullptr && "nothing to read");
        return &array_->datum;
    }

    // If there is nothing to read, only `fresh` may be called.

    /// The datum was not there at the reading before.
    bool fresh() const noexcept { return fresh_; }
    /// Its number, from 1 on; the gap to the number before is the number of data not seen.
    std::uint64_t sequence() const noexcept { return array_->sequence; }
    std::int64_t stamp_ns() const noexcept { return array_->stamp_ns; }

    /// An earlier datum, still in place, or null: LockedBuffer keeps those of the last N - 2 swaps before this one,
    /// WaitFreeBuffer those of the last N - 3 new readings. So a tracker can compare two images without a copy.
    const Datum* previous(std::size_t back) const noexcept { return buffer_->earlier(back); }

  private:
    friend Buffer;
    Reading() noexcept = default;
    // The array is null if there is nothing to read; the access must be ended all the same.
    Reading(Buffer& buffer, const Array<Datum>* array, bool fresh) noexcept
        : buffer_{&buffer}, array_{array}, fresh_{fresh} {}

    Buffer* buffer_ = nullptr;
    const Array<Datum>* array_ = nullptr;
    bool fresh_ = false;
};

/// What both forms can do. `write` is for the producer's thread, `read` and `available` for the consumer's, `account`
/// for every thread; `wakes` and `prepare` come before the tasks start.
template <class B>
concept SwingingBuffer = requires(B& buffer, const B& idle, Watchdog& watchdog) {
    typename B::Datum;
    { buffer.write(watchdog) } -> std::same_as<Writing<B>>;
    { buffer.read(watchdog) } -> std::same_as<Reading<B>>;
    { idle.available() } noexcept -> std::same_as<bool>;
    { idle.account() } noexcept -> std::same_as<Account>;
    buffer.prepare([](typename B::Datum&) {});
};

}  // namespace groundstate
