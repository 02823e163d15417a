// Counters that one thread advances and every thread may read.
//
// Statistics never cost a control task a locked instruction: there is one writer, so a load and a store are enough for
// an increment. Each value is whole; several of them together are a snapshot only while their writer rests.
#pragma once

#include <atomic>
#include <cstdint>

namespace groundstate {

/// A number with one writer and any number of readers.
class Counter {
  public:
    Counter() noexcept = default;
    explicit Counter(std::int64_t value) noexcept : value_{value} {}

    /// Who: the one writer. Blocks: no.
    void add(std::int64_t amount = 1) noexcept { set(value() + amount); }

    /// Who: the one writer. Blocks: no.
    void set(std::int64_t value) noexcept { value_.store(value, std::memory_order_relaxed); }

    /// Who: the one writer. Blocks: no.
    void raise_to(std::int64_t value) noexcept {
        if (value > this->value()) {
            set(value);
        }
    }

    /// Who: any thread. Blocks: no.
    std::int64_t value() const noexcept { return value_.load(std::memory_order_relaxed); }

  private:
    std::atomic<std::int64_t> value_{0};
};

}  // namespace groundstate
