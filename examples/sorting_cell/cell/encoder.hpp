// Belt encoder. What it decides is made from Encoder.asm; here is what its sensors say.
#pragma once

#include "belt.hpp"
#include "generated/sorting_cell_machines.hpp"

namespace sorting_cell {

class EncoderHooks final : public EncoderMachine {
  public:
    explicit EncoderHooks(Belt& belt) : belt_{belt} {}
    bool mark(const Cycle& cycle) override { return belt_.mark(since_start(cycle, origin_ns_)); }

  private:
    Belt& belt_;
    std::int64_t origin_ns_ = 0;
};

}  // namespace sorting_cell
