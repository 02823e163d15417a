// How long things take in a run: in real time as long as they do, in virtual time as long as the model says.
//
// Computing takes no virtual time, so a generated task says how long each phase lasts. `Pace::modelled` follows the
// model tick by tick: a step of the model is a tick, all tasks step at once, and the others see in the next step what a
// task does in this one. To get the same from threads that run one after the other, a tick is divided:
//
//     0    the step: phases begin, granted locks are entered, indexes are swapped, data are read
//     1/4  what is released in this step                       3/8  an asynchronous task looks whether data are there
//     7/16 a slave's writing that begins is there to be awaited
//     5/8  messages are taken                                  3/4  messages are sent, and values stored
//     13/16 locks asked for in this step, the more urgent first
//
// Locks come last, since a task that hands something over may begin its next cycle, and ask, in the same step.
//
// With `Pace::drawn` each phase lasts a part of its modelled time, drawn from a seed, or occasionally far longer; an
// elaboration of an interval lasts no less than its shortest time. Locks take no time. It is for trying other orders of
// events. INVARIANT: the program sees nothing of this but the passing of time.
#pragma once

#include <cstdint>

#include "virtual_clock.hpp"

namespace groundstate {

enum class Pace : std::uint8_t { modelled, drawn };

/// What the tasks of a run have in common.
struct Pacing {
    Pace pace = Pace::modelled;
    std::int64_t tick_ns = 1;
    std::uint64_t seed = 0;
    int overrun = 1;  ///< of `drawn`: one phase in sixteen lasts up to so many times its modelled time
};

/// In real time: nothing is waited for.
template <Clock C>
class TaskPace {
  public:
    TaskPace(C&, const Pacing&, std::uint64_t) noexcept {}
    static constexpr bool is_modelled() noexcept { return false; }
    void ask(bool) noexcept {}
    void enter() noexcept {}
    void managed() noexcept {}
    void release() noexcept {}
    bool offer() noexcept { return false; }
    void look() noexcept {}
    void take() noexcept {}
    void hand_over() noexcept {}
    void rest() noexcept {}
    void begin_cycle(bool) noexcept {}
    void end_cycle() noexcept {}
    void spend(std::int64_t, std::int64_t = 0) noexcept {}
};

/// In virtual time. One task's; its thread alone calls.
template <>
class TaskPace<VirtualClock> {
  public:
    TaskPace(VirtualClock& clock, const Pacing& pacing, std::uint64_t task) noexcept
        : clock_{clock}, pacing_{pacing}, random_{pacing.seed * 0x9e3779b97f4a7c15U + task + 1} {}

    bool is_modelled() const noexcept { return pacing_.pace == Pace::modelled; }

    /// Before a lock is asked for; the more urgent of two goes first.
    void ask(bool urgent) noexcept { reach(sixteenths(), urgent ? 13 : 14); }
    /// After the lock was granted, or given up: the others see that in the next step.
    void enter() noexcept { reach(16, 0); }
    /// The index section of a master is a step.
    void managed() noexcept { reach(16, 0); }
    void release() noexcept { reach(sixteenths(), 4); }
    /// When a slave begins to write: whether its reader, which swaps, awaits that already; the reader sees it in the
    /// next step.
    bool offer() noexcept {
        reach(sixteenths(), 7);
        return is_modelled();
    }
    /// Before looking for room in a queue.
    void look() noexcept { reach(sixteenths() == 0 ? 0 : 16, 0); }
    void take() noexcept { reach(sixteenths(), 10); }
    /// Before a message or a value is there for the other side; in the next step, if its room was made in this one.
    void hand_over() noexcept { reach(sixteenths() > 8 ? 16 : 0, 12); }
    /// Before an asynchronous task looks for data: it rests for a step after a cycle.
    void rest() noexcept {
        if (is_modelled()) {
            const std::int64_t now = clock_.now_ns() * 16 / pacing_.tick_ns;
            const std::int64_t step = std::max((now - 6 + 15) / 16, ended_ + 1);
            clock_.sleep_until_ns(step * pacing_.tick_ns + length_ns(6));
        }
    }
    /// A synchronous task of a single phase cannot leave and enter the same pattern machine in one step.
    void begin_cycle(bool single) noexcept {
        if (is_modelled() && single && step() <= ended_) {
            clock_.sleep_until_ns((ended_ + 1) * pacing_.tick_ns);
        }
    }
    void end_cycle() noexcept { ended_ = step(); }

    /// A phase, or an access, lasts this many ticks, but at least a step; where time is drawn, `least` ticks at the least.
    void spend(std::int64_t ticks, std::int64_t least = 0) noexcept {
        if (is_modelled()) {
            clock_.sleep_until_ns((step() + std::max<std::int64_t>(ticks, 1)) * pacing_.tick_ns);
        } else {
            const int times = pacing_.overrun > 1 && drawn() % 16 == 0 ? pacing_.overrun : 1;
            const std::int64_t least_ns = least * pacing_.tick_ns;
            const std::int64_t more_ns = std::max<std::int64_t>(ticks, 1) * pacing_.tick_ns * times - least_ns;
            const auto part = static_cast<std::int64_t>(drawn() % static_cast<std::uint64_t>(std::max<std::int64_t>(more_ns, 1)));
            clock_.sleep_until_ns(clock_.now_ns() + least_ns + part);
        }
    }

  private:
    std::int64_t step() const noexcept { return clock_.now_ns() / pacing_.tick_ns; }
    std::int64_t sixteenths() const noexcept { return clock_.now_ns() % pacing_.tick_ns * 16 / pacing_.tick_ns; }

    std::int64_t length_ns(std::int64_t sixteenths) const noexcept { return (sixteenths * pacing_.tick_ns + 15) / 16; }

    // Sleeps until a part of this step, or of the next one if `from` is 16 or the part has passed.
    void reach(std::int64_t from, std::int64_t part) noexcept {
        if (is_modelled()) {
            const std::int64_t whole = step() + (from == 16 ? 1 : 0);
            clock_.sleep_until_ns(whole * pacing_.tick_ns + length_ns(part));
        }
    }

    // splitmix64: the same numbers everywhere.
    std::uint64_t drawn() noexcept {
        std::uint64_t z = random_ += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }

    VirtualClock& clock_;
    Pacing pacing_;
    std::uint64_t random_;
    std::int64_t ended_ = -1;
};

}  // namespace groundstate
