// Right pusher. What it decides is made from RightPusher.asm; here is what its sensors say and its arm does.
#pragma once

#include "belt.hpp"
#include "generated/sorting_cell_machines.hpp"

namespace sorting_cell {

class RightPusherHooks final : public RightPusherMachine {
  public:
    explicit RightPusherHooks(Belt& belt) : belt_{belt} {}
    bool stop(const Cycle& cycle) override { return belt_.stop(since_start(cycle, origin_ns_)); }
    void right_arm(const Cycle& cycle, bool out) override {
        const std::int64_t ms = since_start(cycle, origin_ns_);
        if (out && !was_out_) {
            belt_.push(ms, Belt::Goes::right);
        }
        was_out_ = out;
        last_ms_ = ms;
    }
    void safe_stop() noexcept override { belt_.tell(last_ms_); }

  private:
    Belt& belt_;
    std::int64_t origin_ns_ = 0;
    std::int64_t last_ms_ = 0;
    bool was_out_ = false;
};

}  // namespace sorting_cell
