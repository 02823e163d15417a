// The belt, as its sensors see it: a parcel each 80 ms, or as stated, which lies under the camera, then at the left arm, then at the right one.
//
// What a sensor says depends on the time alone. What the arms do is noted for each parcel, and judged at the end.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace sorting_cell {

class Belt {
  public:
    enum class Goes : std::uint8_t { left, right, end };

    /// In milliseconds. In the environment STOP_MS says when somebody presses the emergency stop, STEP_MS how often a parcel comes.
    Belt() : stop_ms_{stated("STOP_MS", never)}, step_{std::max<std::int64_t>(stated("STEP_MS", 80), 1)} {}

    bool mark(std::int64_t ms) const { return ms >= moves && (ms - moves) % step_ < 5; }
    bool seen(std::int64_t ms) const { return ms >= comes && (ms - comes) % step_ < 15; }
    std::int64_t printed(std::int64_t ms) const { return digit((ms - comes) / step_); }
    std::int64_t outline(std::int64_t ms) const { return dent((ms - comes) / step_); }
    bool stop(std::int64_t ms) const { return ms >= stop_ms_; }

    /// An arm goes out.
    void push(std::int64_t ms, Goes bin) {
        const std::int64_t parcel = (ms - moves) / step_ - (bin == Goes::left ? 1 : 2);
        ++pushes_;
        late_ += ms >= stop_ms_;
        wrong_ += parcel < 0 || goes(parcel) != bin || parcel <= last_[bin == Goes::left];
        last_[bin == Goes::left] = parcel;
    }

    /// Says what became of the parcels that have passed both arms by then.
    void tell(std::int64_t ms) const {
        std::int64_t due = 0;
        for (std::int64_t parcel = 0; parcel < (ms - moves) / step_ - 2; ++parcel) {
            due += goes(parcel) != Goes::end;
        }
        std::printf("%lld pushes, %lld of them wrong, %lld after the stop; %lld parcels were to be pushed\n", pushes_.load(), wrong_.load(), late_.load(),
                    static_cast<long long>(due));
    }

  private:
    static constexpr std::int64_t moves = 30;
    static constexpr std::int64_t comes = 40;
    static constexpr int never = 1'000'000'000;
    static constexpr std::array<std::int64_t, 10> digits{1, 6, 4, 0, 8, 2, 5, 3, 9, 7};
    static constexpr std::array<std::int64_t, 7> dents{0, 2, 1, 3, 5, 0, 1};

    static std::int64_t stated(const char* name, std::int64_t otherwise) {
        const char* const text = std::getenv(name);
        return text == nullptr ? otherwise : std::atoi(text);
    }

    static std::int64_t digit(std::int64_t parcel) { return digits[static_cast<std::size_t>(parcel) % digits.size()]; }
    static std::int64_t dent(std::int64_t parcel) { return dents[static_cast<std::size_t>(parcel) % dents.size()]; }

    static Goes goes(std::int64_t parcel) {
        if (dent(parcel) > 3 || digit(parcel) < 1 || digit(parcel) > 8) {
            return Goes::end;
        }
        return digit(parcel) <= 4 ? Goes::left : Goes::right;
    }

    std::int64_t stop_ms_;
    std::int64_t step_;
    std::atomic<long long> pushes_{0};
    std::atomic<long long> wrong_{0};
    std::atomic<long long> late_{0};
    std::array<std::int64_t, 2> last_{-1, -1};
};

/// When a cycle is due, in milliseconds since the first one.
template <class Cycle>
std::int64_t since_start(const Cycle& cycle, std::int64_t& origin_ns) {
    if (cycle.number == 0) {
        origin_ns = cycle.start_ns;
    }
    return (cycle.start_ns - origin_ns) / 1'000'000;
}

}  // namespace sorting_cell
