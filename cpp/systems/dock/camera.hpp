// The camera of the dock: a number that differs from frame to frame; every fifth frame shows nothing.
#pragma once

#include "generated/dock.hpp"

namespace dock {

class CameraHooks final : public Camera {
  public:
    bool shoot(const Cycle& /*cycle*/, const In& /*in*/, Out& out) override {
        out.sighting.value = (frames_ * 7) % 11;
        out.sighting.known = true;
        frames_ += 1;
        return frames_ % 5 != 0;
    }

  private:
    std::int64_t frames_ = 0;
};

}  // namespace dock
