// Line-scan camera. What it decides is made from Camera.asm; here is what its sensors say.
#pragma once

#include "belt.hpp"
#include "generated/sorting_cell_machines.hpp"

namespace sorting_cell {

class CameraHooks final : public CameraMachine {
  public:
    explicit CameraHooks(Belt& belt) : belt_{belt} {}
    bool seen(const Cycle& cycle) override { return belt_.seen(since_start(cycle, origin_ns_)); }
    std::int64_t printed(const Cycle& cycle) override { return belt_.printed(since_start(cycle, origin_ns_)); }
    std::int64_t outline(const Cycle& cycle) override { return belt_.outline(since_start(cycle, origin_ns_)); }

  private:
    Belt& belt_;
    std::int64_t origin_ns_ = 0;
};

}  // namespace sorting_cell
