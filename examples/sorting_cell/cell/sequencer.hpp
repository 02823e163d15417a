// Sequencer. What it decides is made from Sequencer.asm; here is what its sensors say.
#pragma once

#include "belt.hpp"
#include "generated/sorting_cell_machines.hpp"

namespace sorting_cell {

class SequencerHooks final : public SequencerMachine {
  public:
    explicit SequencerHooks(Belt& belt) : belt_{belt} {}
    bool stop(const Cycle& cycle) override { return belt_.stop(since_start(cycle, origin_ns_)); }

  private:
    Belt& belt_;
    std::int64_t origin_ns_ = 0;
};

}  // namespace sorting_cell
