// The swinging buffer without waiting: N >= 3 arrays, and one word that says which of them holds the latest datum.
//
// The producer has one of the arrays, the consumer N - 2, and one lies between them. To publish, the producer exchanges
// its array for the one between. To read, the consumer exchanges its oldest one for it, if it is new. Each of the two
// leaves with the array that the exchange gave it, so every array has one holder at any moment.
// library/runtime/LatestValue.asm states this for every interleaving.
//
// Both sides take a bounded number of their own steps, whatever the other one does. There is no master, no lock and
// nothing to give up, and the watchdog that the interface asks for is ignored.
#pragma once

#include <array>
#include <numeric>
#include <type_traits>

#include "observer.hpp"
#include "signal.hpp"
#include "swinging_buffer.hpp"

namespace groundstate {

/// A swinging buffer of `N` arrays of `T` between one producer and one consumer; neither waits.
template <class T, std::size_t N, Clock C, class Observer = Unobserved>
class WaitFreeBuffer {
    static_assert(N >= 3 && N <= 128, "one array to write, one to read, and one between them");

  public:
    using Datum = T;

    explicit WaitFreeBuffer(C& clock, Observer observer = {}) : observer_{observer}, clock_{clock} {
        std::iota(held_.begin(), held_.end(), Index{2});
    }

    WaitFreeBuffer(const WaitFreeBuffer&) = delete;
    WaitFreeBuffer& operator=(const WaitFreeBuffer&) = delete;

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
    /// written and published is never handed over. Who: the producer. Blocks: no.
    T& own() noexcept { return arrays_[written_array_].datum; }

    /// Begins to write, in place; the datum is an earlier one. Always succeeds, one writing at a time.
    /// Who: the producer. Blocks: no. Allocates: no. Worst case: a few instructions.
    /// Publishing it: one atomic exchange, one read of the clock, and one system call if the consumer waits.
    Writing<WaitFreeBuffer> write(Watchdog& watchdog) noexcept {
        if (!writing_.begin()) {
            dropped_.add();
            return {};
        }
        return {*this, arrays_[written_array_], watchdog};
    }

    /// Begins to read the latest datum, in place. Who: the consumer. Blocks: no. Allocates: no.
    /// Worst case: one atomic exchange.
    Reading<WaitFreeBuffer> read(Watchdog&) noexcept {
        if (!reading_.begin()) {
            missed_.add();
            return {};
        }
        const bool fresh = available() && !observer_.seeded(Fault::stale_read);
        if (fresh) {
            newest_ = (newest_ + 1) % kept;
            // SYNC(exchange): acquire: the datum was written before the producer's exchange, and is read after this
            // one. Release: the array given back was read before this exchange, and is written after the producer's.
            held_[newest_] = between_.exchange(held_[newest_], std::memory_order_acq_rel) & index_mask;
            read_.add();
        }
        if constexpr (!std::is_same_v<Observer, Unobserved>) {
            observer_.loads(read_.value() != 0 ? arrays_[held_[newest_]].sequence : 0, fresh);
        }
        // The array itself is not touched: it may still be in the cache of the producer's processor.
        return {*this, read_.value() != 0 ? &arrays_[held_[newest_]] : nullptr, fresh};
    }

    /// Reading now gives something new. Who: the consumer. Blocks: no.
    bool available() const noexcept {
        // relaxed: only the consumer takes the mark away, so it is still there at the exchange, which does the
        // ordering.
        return (between_.load(std::memory_order_relaxed) & fresh_mark) != 0;
    }

    /// Who: any thread. Blocks: no.
    Account account() const noexcept {
        return {.written = written_.value(),
                .handed_over = written_.value(),
                .overwritten = 0,
                .read = read_.value(),
                .unread = unread_.value(),
                .dropped = dropped_.value(),
                .withdrawn = withdrawn_.value(),
                .missed = missed_.value()};
    }

    C& clock() const noexcept { return clock_; }

  private:
    friend Writing<WaitFreeBuffer>;
    friend Reading<WaitFreeBuffer>;

    using Index = std::uint8_t;
    static constexpr Index fresh_mark = 0x80;
    static constexpr Index index_mask = 0x7f;
    static constexpr std::size_t kept = N - 2;

    bool hand_over(std::int64_t stamp_ns, Watchdog&) noexcept {
        writing_.end();
        Array<T>& array = arrays_[written_array_];
        written_.add();
        array.sequence = static_cast<std::uint64_t>(written_.value());
        array.stamp_ns = stamp_ns;
        observer_.stores(array.sequence);
        if (observer_.seeded(Fault::index_not_swapped)) {
            return true;
        }
        // SYNC(exchange): release: the datum was written before this exchange, and is read after the consumer's.
        // Acquire: what comes back was read before the consumer's exchange, and is written after this one.
        const Index back =
            between_.exchange(static_cast<Index>(written_array_ | fresh_mark), std::memory_order_acq_rel);
        written_array_ = back & index_mask;
        if ((back & fresh_mark) != 0) {
            unread_.add();
        }
        if (trigger_ != nullptr) {
            trigger_->raise();
        }
        return true;
    }

    void withdraw() noexcept {
        writing_.end();
        withdrawn_.add();
    }
    void end_read() noexcept { reading_.end(); }

    // The consumer's arrays are a ring, from the newest back.
    const T* earlier(std::size_t back) const noexcept {
        const Array<T>& array = arrays_[held_[(newest_ + kept - back % kept) % kept]];
        return back < kept && array.sequence != 0 ? &array.datum : nullptr;
    }

    [[no_unique_address]] Observer observer_;
    std::array<Array<T>, N> arrays_{};

    // INVARIANT: written_array_, between_ and held_ name each array once.
    alignas(64) std::atomic<Index> between_{1};

    // The producer's data lie together, and so do the consumer's.
    alignas(64) C& clock_;
    Signal<C>* trigger_ = nullptr;
    Index written_array_ = 0;
    Counter written_{};
    Counter unread_{};
    Counter withdrawn_{};
    Counter dropped_{};  ///< second writings at once
    Access writing_{};

    alignas(64) std::size_t newest_ = 0;
    std::array<Index, kept> held_{};
    Counter read_{};
    Counter missed_{};  ///< second readings at once
    Access reading_{};
};

}  // namespace groundstate
