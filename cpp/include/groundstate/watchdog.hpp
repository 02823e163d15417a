// The bound on a task's waiting, as in the paper's Figures 9 and 10 and `thereIsTime` in library/patterns/Task.asm.
//
// A cycle may wait only as long as its work still fits into the period: budget = period - elaboration. Every wait of
// the cycle draws on the same budget, and so does a late beginning. When the budget is used up, the wait is given up
// and the action left out, and that is counted. A budget is always finite: no operation of the runtime waits without
// end.
#pragma once

#include <algorithm>
#include <cassert>

#include "clock.hpp"
#include "counter.hpp"

namespace groundstate {

/// The time that a task may still spend waiting in this cycle.
class Watchdog {
  public:
    /// The time that one cycle may spend waiting; 0 tries once and never waits. A wait takes whole grains off the
    /// budget; a grain is a tick of a model that is followed in virtual time.
    explicit Watchdog(std::int64_t budget_ns, std::int64_t grain_ns = 1) noexcept
        : budget_ns_{budget_ns}, grain_ns_{grain_ns} {
        assert(budget_ns >= 0 && budget_ns < never_ns && grain_ns > 0);
    }

    /// A new cycle has the whole budget again, minus the time by which it began late. Who: the task. Blocks: no.
    void restart(std::int64_t late_ns = 0) noexcept {
        waited_ns_ = 0;
        spent_ns_ = late_ns;
    }

    /// What is left of the budget. Who: the task. Blocks: no.
    std::int64_t left_ns() const noexcept { return std::max<std::int64_t>(budget_ns_ - spent_ns_, 0); }

    /// Takes a wait off the budget. Who: the task. Blocks: no.
    void waited(std::int64_t span_ns) noexcept {
        span_ns = (span_ns + grain_ns_ - 1) / grain_ns_ * grain_ns_;
        waited_ns_ += span_ns;
        spent_ns_ += span_ns;
        total_wait_ns_.add(span_ns);
        longest_wait_ns_.raise_to(waited_ns_);
    }

    /// An action was left out, because waiting any longer would miss the deadline. Who: the task. Blocks: no.
    void skip() noexcept { skipped_.add(); }

    // Who: any thread. Block: no.
    std::int64_t budget_ns() const noexcept { return budget_ns_; }
    std::int64_t total_wait_ns() const noexcept { return total_wait_ns_.value(); }
    /// The longest waiting of one cycle.
    std::int64_t longest_wait_ns() const noexcept { return longest_wait_ns_.value(); }
    std::int64_t skipped() const noexcept { return skipped_.value(); }

  private:
    std::int64_t budget_ns_;
    std::int64_t grain_ns_;
    std::int64_t waited_ns_ = 0;
    std::int64_t spent_ns_ = 0;  ///< of the budget: by beginning late, and by waiting
    Counter total_wait_ns_{};
    Counter longest_wait_ns_{};
    Counter skipped_{};
};

}  // namespace groundstate
