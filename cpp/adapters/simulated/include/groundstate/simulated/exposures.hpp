// When a simulated camera takes its frames, which of them arrive, and when: pure arithmetic, the same for each seed.
//
// Frame n is taken at origin + (n - 1) * period, and arrives a readout later; a slow one later still, so that newer
// ones may be there before it; a lost one never. Whether a frame is slow or lost is drawn from the seed and its number
// alone, not from when anybody looks.
#pragma once

#include <algorithm>
#include <cstdint>

#include <groundstate/clock.hpp>

namespace groundstate::simulated {

/// What may go wrong with a frame, each with its probability, and where the frames end. All is off unless set.
struct Faults {
    std::uint64_t seed = 1;
    double lost = 0;                   ///< frames that never arrive
    double slow = 0;                   ///< frames that arrive late, by
    std::int64_t slow_ns = 0;          ///< so much
    double damaged = 0;                ///< frames of which only the upper half arrives
    double occluded = 0;               ///< frames with which something begins to cover one of the discs, for
    std::uint64_t occluded_frames = 5; ///< so many frames
    double noise = 0;                  ///< of each pixel: the standard deviation, in steps of brightness
    double blur = 0;                   ///< of the lens: the standard deviation, in pixels
    std::uint64_t end_after = 0;       ///< the recording has so many frames; 0: it does not end
    std::uint64_t unplug_after = 0;    ///< the camera takes so many frames and is gone at the next one; 0: never
};

/// What is drawn by lot for a frame.
enum class Lot : std::uint64_t { lost = 1, slow, damaged, occluded, disc, noise };

/// A number that depends on its arguments alone.
constexpr std::uint64_t lot(std::uint64_t seed, Lot of, std::uint64_t frame) noexcept {
    std::uint64_t x = seed * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(of) * 0xd1b54a32d192ed03u + frame;
    for (const std::uint64_t factor : {0xbf58476d1ce4e5b9u, 0x94d049bb133111ebu}) {
        x = (x ^ x >> 30) * factor;
    }
    return x ^ x >> 31;
}

/// The frame is one of those that the probability makes so.
constexpr bool falls(double probability, std::uint64_t seed, Lot of, std::uint64_t frame) noexcept {
    return probability > 0 && static_cast<double>(lot(seed, of, frame) >> 11) < probability * 0x1p53;
}

/// The frames of a camera, from number 1 on.
class Exposures {
  public:
    Exposures(std::int64_t origin_ns, std::int64_t period_ns, std::int64_t readout_ns, const Faults& faults) noexcept
        : origin_ns_{origin_ns}, period_ns_{period_ns}, readout_ns_{readout_ns}, faults_{faults} {}

    std::int64_t taken_ns(std::uint64_t frame) const noexcept {
        return origin_ns_ + static_cast<std::int64_t>(frame - 1) * period_ns_;
    }

    bool arrives(std::uint64_t frame) const noexcept {
        return frame <= last() && !falls(faults_.lost, faults_.seed, Lot::lost, frame);
    }

    std::int64_t arrival_ns(std::uint64_t frame) const noexcept {
        const bool slow = falls(faults_.slow, faults_.seed, Lot::slow, frame);
        return taken_ns(frame) + readout_ns_ + (slow ? faults_.slow_ns : 0);
    }

    /// The newest of the frames from `first` on that is there; 0 if none is.
    std::uint64_t newest(std::uint64_t first, std::int64_t now_ns) const noexcept {
        for (std::uint64_t frame = std::min(taken(now_ns), last()); frame >= first; --frame) {
            if (arrives(frame) && arrival_ns(frame) <= now_ns) {
                return frame;
            }
        }
        return 0;
    }

    /// When the next one of the frames from `first` on comes; `until_ns` if that is not earlier. None is there now.
    std::int64_t next_ns(std::uint64_t first, std::int64_t until_ns) const noexcept {
        std::int64_t next = until_ns;
        for (std::uint64_t frame = first; frame <= last() && taken_ns(frame) + readout_ns_ < next; ++frame) {
            if (arrives(frame)) {
                next = std::min(next, arrival_ns(frame));
            }
        }
        return next;
    }

    /// The first of the frames from `first` on that may still come.
    std::uint64_t first_open(std::uint64_t first, std::int64_t now_ns) const noexcept {
        return std::max(first, taken(now_ns - readout_ns_ - faults_.slow_ns) + 1);
    }

    /// When there will be nothing more, whoever has taken the frames before `first`.
    std::int64_t end_ns(std::uint64_t first) const noexcept {
        if (unplugs()) {
            return taken_ns(faults_.unplug_after + 1);
        }
        if (faults_.end_after == 0) {
            return never_ns;
        }
        return first > last() ? origin_ns_ : taken_ns(last()) + readout_ns_ + faults_.slow_ns;
    }

    /// The end is that the camera is gone, not that the recording is over.
    bool unplugs() const noexcept {
        return faults_.unplug_after != 0 && (faults_.end_after == 0 || faults_.unplug_after < faults_.end_after);
    }

  private:
    std::uint64_t last() const noexcept {
        return unplugs() ? faults_.unplug_after : faults_.end_after != 0 ? faults_.end_after : UINT64_MAX;
    }

    std::uint64_t taken(std::int64_t now_ns) const noexcept {
        return now_ns < origin_ns_ ? 0 : static_cast<std::uint64_t>((now_ns - origin_ns_) / period_ns_) + 1;
    }

    std::int64_t origin_ns_;
    std::int64_t period_ns_;
    std::int64_t readout_ns_;
    Faults faults_;
};

}  // namespace groundstate::simulated
