// The paper's swinging buffer (section V-B, Figures 8 to 10): N >= 2 arrays and a lock for the indexes.
//
// One of the two, the master, swaps the indexes, and only inside the lock. It works on its array without the lock,
// since no other task moves the index. The other one, the slave, keeps the lock while it works on its array, so that no
// array is swapped away under its hands.
//
//                  writes                           reads
//     master       array, then lock, swap, release  lock, swap, release, then array
//     slave        lock, array, release             lock, array, release
//
// If the watchdog ends first, a master's datum stays pending for its next swap, a master reads the old array, and a
// slave leaves the action out. The protocol is that of library/patterns/{SwingingBuffer,PatternMachines}.asm: the index
// read becomes the index written, which goes on to the next array of the ring; a swap without a pending datum does
// nothing.
//
// SYNC(permit): plain members are shared only under the lock; its release and acquire (pair_lock.hpp) order them.
#pragma once

#include <array>

#include "observer.hpp"
#include "pair_lock.hpp"
#include "signal.hpp"
#include "swinging_buffer.hpp"

namespace groundstate {

/// Which side swaps the indexes: of two synchronous tasks the slower one, otherwise the asynchronous one.
enum class Master { writer, reader };

/// A swinging buffer of `N` arrays of `T` between one producer and one consumer, of which one is the master.
template <class T, std::size_t N, Master master, Clock C, class Observer = Unobserved>
class LockedBuffer {
    static_assert(N >= 2, "one array to write, one to read");

  public:
    using Datum = T;

    explicit LockedBuffer(C& clock, Observer observer = {}) : observer_{observer}, clock_{clock}, lock_{clock} {}

    LockedBuffer(const LockedBuffer&) = delete;
    LockedBuffer& operator=(const LockedBuffer&) = delete;

    /// Gives every array what it needs, so nothing is allocated later. Who: the builder, before the tasks start.
    template <class F>
    void prepare(F&& each) {
        for (Array<T>& array : arrays_) {
            each(array.datum);
        }
    }

    /// The signal is raised when there is something new to read. Who: the builder, before the tasks start.
    void wakes(Signal<C>& trigger) noexcept { trigger_ = &trigger; }

    /// The array of the next writing, for preparing the datum in place beforehand. A datum left there without being
    /// written and published is never handed over.
    /// Who: the producer, if it is the master: no other task moves the index. Blocks: no.
    T& own() noexcept
        requires(master == Master::writer)
    {
        return arrays_[index_write_].datum;
    }

    /// Begins to write. The datum is the one left there N swaps ago.
    /// Who: the producer. Blocks: a master no; a slave until its watchdog. Allocates: no.
    Writing<LockedBuffer> write(Watchdog& watchdog) noexcept {
        if (!writing_.begin()) {
            dropped_.add();
            return {};
        }
        if constexpr (master == Master::reader) {
            if (!take(Side::producer, watchdog)) {
                writing_.end();
                dropped_.add();
                return {};
            }
        }
        const auto number = static_cast<std::uint64_t>(written_.value()) + 1;
        const bool overwrites = std::exchange(pending_, false);
        if (overwrites) {
            overwritten_.add();
        }
        observer_.writes(index_write_, number);
        if constexpr (master == Master::reader) {
            // By the model a writing is awaited from its beginning, whose lock the reader then waits for; in real time he
            // would be woken only to wait.
            if (observer_.offers()) {
                offered_.store(number, std::memory_order_relaxed);  // SYNC(offer)
                wake();
            } else if (overwrites) {
                offered_.store(arrays_[index_read_].sequence, std::memory_order_relaxed);
            }
        }
        return {*this, arrays_[index_write_], watchdog};
    }

    /// Begins to read. Who: the consumer. Blocks: until its watchdog. Allocates: no.
    /// Worst case without contention: a master two exchanges, a slave one, and one when it ends.
    Reading<LockedBuffer> read(Watchdog& watchdog) noexcept {
        if (!reading_.begin()) {
            missed_.add();
            return {};
        }
        if (!take(Side::consumer, watchdog)) {
            missed_.add();
            if constexpr (master == Master::writer) {
                reading_.end();
                return {};
            }
        } else if constexpr (master == Master::reader) {
            swap();
            give_back(Side::consumer);
        }
        const std::size_t index = observer_.seeded(Fault::stale_read) ? (index_read_ + N - 1) % N : index_read_;
        const std::uint64_t number = arrays_[index].sequence;
        const bool fresh = number != received_.load(std::memory_order_relaxed);
        if (fresh) {
            received_.store(number, std::memory_order_relaxed);
            read_.add();
        }
        observer_.reads(index, number, fresh);
        return {*this, number != 0 ? &arrays_[index] : nullptr, fresh};
    }

    /// Reading now would give something new. Who: the consumer. Blocks: no.
    bool available() const noexcept {
        // SYNC(offer): relaxed is enough: it is a hint, and the datum itself is taken under the lock.
        return offered_.load(std::memory_order_relaxed) != received_.load(std::memory_order_relaxed);
    }

    /// Who: any thread. Blocks: no.
    Account account() const noexcept {
        return {.written = written_.value(),
                .handed_over = handed_over_.value(),
                .overwritten = overwritten_.value(),
                .read = read_.value(),
                .unread = unread_.value(),
                .dropped = dropped_.value(),
                .withdrawn = withdrawn_.value(),
                .missed = missed_.value()};
    }

    C& clock() const noexcept { return clock_; }

  private:
    friend Writing<LockedBuffer>;
    friend Reading<LockedBuffer>;

    [[nodiscard]] bool take(Side side, Watchdog& watchdog) noexcept {
        if (observer_.seeded(Fault::lock_not_taken)) {
            return true;
        }
        observer_.asks(side);
        Watchdog endless{never_ns / 2};
        Watchdog& bound = observer_.seeded(Fault::watchdog_ignored) ? endless : watchdog;
        const bool granted = lock_.acquire(static_cast<int>(side), bound);
        if (granted) {
            observer_.enters(side);
        } else {
            observer_.gives_up(side);
        }
        return granted;
    }

    void give_back(Side side) noexcept {
        if (observer_.seeded(Fault::lock_not_taken)) {
            return;
        }
        observer_.releases(side);
        lock_.release();
    }

    // Ends a writing. Blocks: a master until its watchdog, a slave no. Worst case without contention: two exchanges.
    bool hand_over(std::int64_t stamp_ns, Watchdog& watchdog) noexcept {
        writing_.end();
        Array<T>& array = arrays_[index_write_];
        written_.add();
        array.sequence = static_cast<std::uint64_t>(written_.value());
        array.stamp_ns = stamp_ns;
        pending_ = true;
        if constexpr (master == Master::writer) {
            if (!take(Side::producer, watchdog)) {
                return false;
            }
            swap();
        }
        // SYNC(offer): relaxed, before the signal: a thread that the signal wakes sees it (SYNC(sleeper)).
        offered_.store(array.sequence, std::memory_order_relaxed);
        give_back(Side::producer);
        wake();
        return true;
    }

    void wake() noexcept {
        if (trigger_ != nullptr) {
            trigger_->raise();
        }
    }

    void withdraw() noexcept {
        writing_.end();
        withdrawn_.add();
        if constexpr (master == Master::reader) {
            offered_.store(arrays_[index_read_].sequence, std::memory_order_relaxed);
            give_back(Side::producer);
        }
    }

    void end_read() noexcept {
        reading_.end();
        if constexpr (master == Master::writer) {
            give_back(Side::consumer);
        }
    }

    // The index section; its caller, the master, is inside the lock.
    void swap() noexcept {
        if (!observer_.seeded(Fault::index_not_swapped) && std::exchange(pending_, false)) {
            move_indexes();
        }
        observer_.managed();
    }

    void move_indexes() noexcept {
        if (arrays_[index_read_].sequence != received_.load(std::memory_order_relaxed)) {
            unread_.add();
        }
        index_read_ = index_write_;
        index_write_ = (index_write_ + 1) % N;
        handed_over_.add();
        observer_.swaps(index_read_, index_write_, arrays_[index_read_].sequence);
    }

    // Before the array that is read lie those handed over earlier, back to the one that is written, the next in the
    // ring.
    const T* earlier(std::size_t back) const noexcept {
        const Array<T>& array = arrays_[(index_read_ + N - back % N) % N];
        return back + 2 <= N && array.sequence != 0 ? &array.datum : nullptr;
    }

    [[no_unique_address]] Observer observer_;
    C& clock_;
    PairLock<C> lock_;
    Signal<C>* trigger_ = nullptr;
    std::array<Array<T>, N> arrays_{};

    // Moved by the master inside the lock; read by the slave inside the lock.
    std::size_t index_read_ = N - 1;
    std::size_t index_write_ = 0;
    // The array at index_write_ holds a datum that was not handed over. Shared only if the reader is the master.
    bool pending_ = false;

    alignas(64) std::atomic<std::uint64_t> offered_{0};
    Counter written_{};
    Counter overwritten_{};
    Counter dropped_{};
    Counter withdrawn_{};
    Access writing_{};
    alignas(64) std::atomic<std::uint64_t> received_{0};
    Access reading_{};
    Counter read_{};
    Counter missed_{};
    // The master's.
    alignas(64) Counter handed_over_{};
    Counter unread_{};
};

}  // namespace groundstate
