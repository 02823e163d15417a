// The events of a running program, as spec/conform.md lists them, and the ring that takes them from a task to the writer.
//
// A task puts events of fixed size into a ring of its own. No thread waits for another, and nothing is allocated. If
// the ring is full an event is lost, but its number in the task's order is used up: every reader of the log sees the
// gap.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "counter.hpp"

namespace groundstate {

/// What happened. Of phases: begins to passes; of a buffer's lock: asks to releases; of data: swaps to invalid; of cycles:
/// meets to faults; of what a component's machine says: gets and decides.
enum class Kind : std::uint8_t {
    begins, ends, passes,
    asks, enters, gives_up, releases,
    swaps, writes, reads, sends, refuses, takes, stores, loads, invalid,
    meets, misses, faults,
    gets, decides,
};

/// The word of a kind, in the log.
constexpr std::string_view word(Kind kind) noexcept {
    constexpr std::array words{"begins", "ends",   "passes", "asks",    "enters", "gives_up", "releases",
                               "swaps",  "writes", "reads",  "sends",   "refuses", "takes",   "stores",
                               "loads",  "invalid", "meets", "misses",  "faults", "gets",    "decides"};
    return words[static_cast<std::size_t>(kind)];
}

/// One event of a task.
struct Event {
    std::int64_t time_ns = 0;   ///< since the origin of the run
    std::uint64_t number = 0;   ///< of the datum, message or cycle; of what is got or decided, the value's bits
    std::uint32_t order = 0;    ///< of the task's events, from 0 on
    std::uint16_t object = 0;   ///< the phase or channel, as the plan of the system numbers them
    Kind kind = Kind::begins;
    std::uint8_t array = 0;     ///< the array worked on; of a swap: the index read; of a value: 1 if there is one
    std::uint8_t next = 0;      ///< of a swap: the index written; of a tuple: which part, from 0 on
    bool fresh = false;         ///< of a reading, and of what is got from a channel
};

/// The events of one task on their way to the writer.
class EventRing {
  public:
    /// LIMIT: this many events may wait for the writer.
    static constexpr std::size_t capacity = 4096;

    /// Who: the task. Blocks: no. Allocates: no. False: the ring is full.
    bool push(const Event& event) noexcept {
        const std::uint32_t pushed = pushed_.load(std::memory_order_relaxed);
        // SYNC(popped): acquire, before the slot is written again; pairs with the release in pop().
        if (pushed - popped_.load(std::memory_order_acquire) == capacity) {
            return false;
        }
        slots_[pushed % capacity] = event;
        // SYNC(pushed): release, after the slot was written; pairs with the acquire in pop().
        pushed_.store(pushed + 1, std::memory_order_release);
        return true;
    }

    /// Who: the writer. Blocks: no. False: the ring is empty.
    bool pop(Event& event) noexcept {
        const std::uint32_t popped = popped_.load(std::memory_order_relaxed);
        if (pushed_.load(std::memory_order_acquire) == popped) {  // SYNC(pushed)
            return false;
        }
        event = slots_[popped % capacity];
        popped_.store(popped + 1, std::memory_order_release);  // SYNC(popped)
        return true;
    }

  private:
    std::array<Event, capacity> slots_{};
    alignas(64) std::atomic<std::uint32_t> pushed_{0};
    alignas(64) std::atomic<std::uint32_t> popped_{0};
};

}  // namespace groundstate
