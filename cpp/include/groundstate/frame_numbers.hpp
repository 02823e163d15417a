// Numbers for the frames of a camera that does not number them, from the times at which they were taken.
//
// A driver that overwrites frames, or hands on only some, seldom says so; but a camera that takes one each period has
// taken round(gap / period) of them between two stamps. A period that is not known, or a clock that jumps, makes every
// frame the next one.
#pragma once

#include <cstdint>

namespace groundstate {

/// Turns stamps that a driver gave into numbers and stamps that rise.
class FrameNumbers {
  public:
    /// A period of 0: not known.
    explicit FrameNumbers(std::int64_t period_ns) noexcept : period_ns_{period_ns} {}

    /// The number of the frame taken then, which is the next one that came, delivered or not; `stamp_ns()` is then its
    /// stamp.
    std::uint64_t next(std::int64_t taken_ns) noexcept {
        const std::int64_t gap_ns = sequence_ == 0 ? 0 : taken_ns - stamp_ns_;
        const std::int64_t taken = period_ns_ > 0 ? (gap_ns + period_ns_ / 2) / period_ns_ : 1;
        sequence_ += taken > 1 ? static_cast<std::uint64_t>(taken) : 1;
        // A stamp that does not rise is the driver's fault; the order is kept all the same.
        stamp_ns_ = sequence_ == 1 || gap_ns > 0 ? taken_ns : stamp_ns_ + 1;
        return sequence_;
    }

    std::int64_t stamp_ns() const noexcept { return stamp_ns_; }

  private:
    std::int64_t period_ns_;
    std::uint64_t sequence_ = 0;
    std::int64_t stamp_ns_ = 0;
};

}  // namespace groundstate
