// What a chart bounds of a running program, and how often the program was outside: how late cycles are released, how long elaborations
// take, how often readings bring something new, how many deadlines are missed, how old data get.
//
// In: what a task does, as it does it. Out: for each bound how often it was looked at, how often it was not kept, and the greatest value. A
// bound is counted by the thread of one task. The meaning of each is that of the models: library/patterns/{ReleaseJitter, VaryingTimes,
// FreshReadings, MissedDeadlines, DataAges}.asm.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "clock.hpp"
#include "counter.hpp"

namespace groundstate {

/// What is bounded.
enum class Bounded : std::uint8_t { release, elaboration, reading, misses, age };

/// A bound as the chart has it.
struct BoundPlan {
    Bounded kind = Bounded::release;
    const char* what = "";      ///< in words: `look of camera`
    const char* limit = "";     ///< as it is written: `3..9 ms`
    std::size_t task = 0;       ///< whose thread counts
    std::uint16_t phase = 0;    ///< of an elaboration or a reading: its number among the names
    std::int64_t least = 0;     ///< in ticks
    std::int64_t most = 0;      ///< in ticks; of missed deadlines: how many
    std::int64_t cycles = 0;    ///< of missed deadlines: of how many successive cycles
};

/// What is left of a bound after a run. Lengths are in nanoseconds; of missed deadlines, `greatest` is a number.
struct BoundAccount {
    std::string what{};
    std::string limit{};
    bool is_time = true;
    std::int64_t seen = 0;      ///< how often it was looked at
    std::int64_t below = 0;     ///< shorter than the shortest
    std::int64_t beyond = 0;    ///< longer, later, older or more than the most
    std::int64_t greatest = 0;

    std::int64_t outside() const noexcept { return below + beyond; }
};

/// A bound, and what was seen of it.
class Bound {
  public:
    /// Who: the builder of the system. Allocates: yes.
    Bound(const BoundPlan& plan, std::int64_t tick_ns) : plan_{plan}, late_(static_cast<std::size_t>(plan.cycles)) {
        const std::int64_t unit = plan.kind == Bounded::misses ? 1 : tick_ns;
        least_ = plan.least * unit;
        most_ = plan.most * unit;
    }

    bool is(Bounded kind) const noexcept { return plan_.kind == kind; }
    bool is(Bounded kind, std::uint16_t phase) const noexcept { return plan_.kind == kind && plan_.phase == phase; }

    /// A length that has to lie within the bound. Who: the task. Blocks: no. Allocates: no.
    void saw(std::int64_t length_ns) noexcept {
        seen_.add();
        greatest_.raise_to(length_ns);
        if (length_ns < least_) {
            below_.add();
        } else if (length_ns > most_) {
            beyond_.add();
        }
    }

    /// A reading brings something new at this instant: the time from the one before counts. Who: the task.
    void saw_new(std::int64_t now_ns) noexcept {
        if (last_ns_ != never_ns) {
            saw(now_ns - last_ns_);
        }
        last_ns_ = now_ns;
    }

    /// A cycle is done, in time or not. A late one counts with those among the cycles before it. Who: the task.
    void saw_cycle(bool is_late) noexcept {
        seen_.add();
        if (late_.empty()) {
            return;
        }
        const bool leaves = late_[next_];
        late_[next_] = is_late;
        next_ = next_ + 1 == late_.size() ? 0 : next_ + 1;
        missed_ += (is_late ? 1 : 0) - (leaves ? 1 : 0);
        if (is_late) {
            greatest_.raise_to(missed_);
            if (missed_ > most_) {
                beyond_.add();
            }
        }
    }

    /// The run is over: a time that still runs is too long by now, or tells nothing. Who: the owner, after the task has ended.
    void end(std::int64_t now_ns) noexcept {
        if (plan_.kind == Bounded::reading && last_ns_ != never_ns && now_ns - last_ns_ > most_) {
            saw(now_ns - last_ns_);
        }
        last_ns_ = never_ns;
    }

    /// Who: any thread. Allocates: yes.
    BoundAccount account() const {
        return {plan_.what, plan_.limit, plan_.kind != Bounded::misses,
                seen_.value(), below_.value(), beyond_.value(), greatest_.value()};
    }

  private:
    BoundPlan plan_;
    std::int64_t least_ = 0;
    std::int64_t most_ = 0;
    std::int64_t last_ns_ = never_ns;  ///< of a reading: when something new came last
    std::vector<bool> late_;           ///< the last cycles, in a ring
    std::size_t next_ = 0;
    std::int64_t missed_ = 0;  ///< among them
    Counter seen_{};
    Counter below_{};
    Counter beyond_{};
    Counter greatest_{};
};

/// A channel as a part of a way.
struct HopPlan {
    std::uint16_t channel = 0;
    std::size_t writer = 0;
    std::size_t reader = 0;
    int decided = -1;  ///< the number of the elaboration in which the writer decides what it writes; -1: there is none
};

/// A way that data take, and how old they may be at its end.
struct WayPlan {
    BoundPlan bound{};  ///< its task is that at the end
    std::size_t first = 0;
    std::vector<HopPlan> hops{};
    int decided = -1;  ///< the number of the elaboration in which the end decides
};

/// When the data of a channel came, by their numbers: one thread writes, one reads.
class Origins {
  public:
    /// Who: the writer, before the datum is handed over. Blocks: no. Allocates: no.
    void set(std::uint64_t number, std::int64_t origin_ns) noexcept {
        Slot& slot = slots_[number % slots_.size()];
        slot.number.store(0, std::memory_order_relaxed);
        // SYNC(origin): release; a reader that gets the new origin also sees that the number is another one.
        slot.origin_ns.store(origin_ns, std::memory_order_release);
        // SYNC(origin number): release; a reader that sees the number gets its origin, or a newer one.
        slot.number.store(number, std::memory_order_release);
    }

    /// `never_ns` if it is not known: the datum had none, or far newer ones have come. Who: the reader. Blocks: no. Allocates: no.
    std::int64_t get(std::uint64_t number) const noexcept {
        const Slot& slot = slots_[number % slots_.size()];
        if (number == 0 || slot.number.load(std::memory_order_acquire) != number) {  // SYNC(origin number)
            return never_ns;
        }
        const std::int64_t origin_ns = slot.origin_ns.load(std::memory_order_acquire);  // SYNC(origin)
        return slot.number.load(std::memory_order_relaxed) == number ? origin_ns : never_ns;
    }

  private:
    struct Slot {
        std::atomic<std::uint64_t> number{0};
        std::atomic<std::int64_t> origin_ns{never_ns};
    };
    /// LIMIT: of data that more than so many newer ones follow, nothing is known.
    std::array<Slot, 1024> slots_{};
};

/// Follows data on a way, by what its tasks do. Each function is called by the task that it names, and does nothing for others.
class Way {
  public:
    /// Who: the builder of the system. Allocates: yes.
    Way(const WayPlan& plan, std::int64_t tick_ns) : plan_{plan}, bound_{plan.bound, tick_ns} {
        for (std::size_t i = 0; i < plan_.hops.size(); ++i) {
            hops_.push_back(std::make_unique<Hop>());
        }
    }

    // Who: that task. Block: no. Allocate: no.
    void begins(std::size_t task, std::int64_t now_ns) noexcept {
        if (task == plan_.first) {
            begun_ns_ = now_ns;
        }
    }
    void ends_phase(std::size_t task, std::uint16_t phase) noexcept {
        for (std::size_t i = 0; i < hops_.size(); ++i) {
            if (plan_.hops[i].writer == task && plan_.hops[i].decided == phase) {
                hops_[i]->taken_ns = origin_ns(i);
            }
        }
        if (plan_.bound.task == task && plan_.decided == phase) {
            taken_ns_ = origin_ns(hops_.size());
        }
    }
    void writes(std::uint16_t channel, std::uint64_t number) noexcept {
        for (std::size_t i = 0; i < hops_.size(); ++i) {
            if (plan_.hops[i].channel == channel) {
                hops_[i]->origins.set(number, plan_.hops[i].decided < 0 ? origin_ns(i) : hops_[i]->taken_ns);
                hops_[i]->taken_ns = never_ns;
            }
        }
    }
    void reads(std::uint16_t channel, std::uint64_t number) noexcept {
        for (std::size_t i = 0; i < hops_.size(); ++i) {
            if (plan_.hops[i].channel == channel && number != hops_[i]->number) {
                hops_[i]->number = number;
                hops_[i]->received_ns = hops_[i]->origins.get(number);
            }
        }
    }
    void ends_cycle(std::size_t task, std::int64_t now_ns) noexcept {
        if (task != plan_.bound.task) {
            return;
        }
        const std::int64_t taken_ns = plan_.decided < 0 ? origin_ns(hops_.size()) : taken_ns_;
        if (taken_ns != never_ns) {
            bound_.saw(now_ns - taken_ns);
        }
        taken_ns_ = never_ns;
    }

    const Bound& bound() const noexcept { return bound_; }

  private:
    // The line of the writer and that of the reader are apart.
    struct Hop {
        alignas(64) std::int64_t taken_ns = never_ns;  ///< the writer's: what was decided rests on it
        Origins origins{};
        alignas(64) std::int64_t received_ns = never_ns;  ///< the reader's
        std::uint64_t number = 0;
    };

    // When that came which the writer of this hop, or the end of the way, has at hand.
    std::int64_t origin_ns(std::size_t hop) const noexcept {
        return hop == 0 ? begun_ns_ : hops_[hop - 1]->received_ns;
    }

    WayPlan plan_;
    Bound bound_;
    std::int64_t begun_ns_ = never_ns;  ///< the first task's
    std::int64_t taken_ns_ = never_ns;  ///< the last task's
    std::vector<std::unique_ptr<Hop>> hops_{};
};

}  // namespace groundstate
