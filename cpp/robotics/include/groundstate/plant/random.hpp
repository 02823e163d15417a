// Chance that is the same everywhere for one seed: SplitMix64 (Steele, Lea & Flood 2014) and the polar method.
#pragma once

#include <cmath>
#include <cstdint>

namespace groundstate::plant {

class Random {
  public:
    explicit Random(std::uint64_t seed) noexcept : state_{seed} {}

    std::uint64_t bits() noexcept {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    /// From 0 to below 1.
    double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    bool happens(double probability) noexcept { return uniform() < probability; }

    /// Of mean 0 and deviation 1.
    double normal() noexcept {
        for (;;) {
            const double a = 2 * uniform() - 1;
            const double b = 2 * uniform() - 1;
            const double s = a * a + b * b;
            if (s > 0 && s < 1) {
                return a * std::sqrt(-2 * std::log(s) / s);
            }
        }
    }

  private:
    std::uint64_t state_;
};

}  // namespace groundstate::plant
