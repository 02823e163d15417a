// The phases of a generated task, each the work of one pattern machine of library/patterns: read, write, send, receive,
// store, load, elaborate.
//
// A phase records its beginning and end, and in virtual time takes as long as the model says. The roles decide which of
// two forms a reading or writing has. The master of a buffer, and both sides of a wait-free one, work in the channel's
// own array. A slave holds the lock while it works there; so it copies the datum in its phase and elaborates on its own
// copy, because the pattern's index section must stay short.
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "message_queue.hpp"
#include "observation.hpp"
#include "seen.hpp"
#include "task.hpp"
#include "tuple.hpp"

namespace groundstate {

/// A phase of the plan: its number among the names, how many ticks it takes, and the fewest, if the chart says that it may take fewer.
struct Phase {
    std::uint16_t number = 0;
    std::int64_t ticks = 1;
    std::int64_t least = 0;
};

/// A message as a queue holds it.
template <class T>
struct Message {
    T datum{};
    std::int64_t stamp_ns = 0;
};

/// A value as the log has it: an enum by its place, a number by its bits.
template <class T>
constexpr std::uint64_t bits_of(const T& value) noexcept {
    if constexpr (std::is_floating_point_v<T>) {
        return std::bit_cast<std::uint64_t>(static_cast<double>(value));
    } else {
        return static_cast<std::uint64_t>(value);
    }
}

/// Runs the phases of one task's cycle, in order.
template <Clock C>
class Phases {
  public:
    Phases(TaskContext<C>& task, const Cycle& cycle) noexcept : task_{task}, cycle_{cycle} {}

    /// The component's own work: `step` returns whether there is something to hand over.
    template <class Step>
    bool elaborate(Phase phase, Step&& step) {
        const std::int64_t begun_ns = begin(phase);
        const bool ready = step();
        task_.progress(phase.number);
        task_.pace.spend(phase.ticks, phase.least);
        task_.elaborated(phase.number, task_.instant_ns() - begun_ns);
        end(phase);
        return ready;
    }

    /// A step of the component's machine. In virtual time it is made when the phase ends, on what the sensors say then, as in the model.
    template <class Step>
    bool decide(Phase phase, Step&& step) {
        const std::int64_t begun_ns = begin(phase);
        task_.pace.spend(phase.ticks, phase.least);
        const bool ready = step();
        task_.progress(phase.number);
        task_.elaborated(phase.number, task_.instant_ns() - begun_ns);
        end(phase);
        return ready;
    }

    /// What the component decides on: the datum that it read last from a channel, what a sensor says.
    template <class T>
    void gets(std::uint16_t channel, const Seen<T>& seen) {
        values(Kind::gets, channel, seen && seen->known ? &seen->value : nullptr, seen.fresh);
    }
    template <class T>
    void senses(std::uint16_t sensor, const T& value) {
        values(Kind::gets, sensor, &value, false);
    }

    /// What it has decided for a channel or an actuator, if anything.
    template <class T>
    void decides(std::uint16_t object, const T& value, bool is_known) {
        values(Kind::decides, object, is_known ? &value : nullptr, false);
    }

    /// Reads in place: the master's array, or that of a wait-free buffer.
    template <class Buffer, class T>
    void read_in_place(Phase phase, Buffer& buffer, Seen<T>& seen) {
        begin(phase);
        {
            const auto reading = buffer.read(cycle_.watchdog);
            show(reading, reading ? &*reading : nullptr, seen);
            tell_new(phase, seen);
            task_.pace.spend(phase.ticks);
        }
        end(phase);
    }

    /// Reads a copy, holding the lock. If the watchdog ends first, the datum before stays, no longer fresh.
    template <class Buffer, class T>
    void read_copy(Phase phase, Buffer& buffer, T& copy, Seen<T>& seen) {
        begin(phase);
        {
            const auto reading = buffer.read(cycle_.watchdog);
            if (reading.attempted()) {
                if (reading && reading.fresh()) {
                    copy = *reading;
                }
                show(reading, reading ? &copy : nullptr, seen);
                tell_new(phase, seen);
                task_.pace.spend(phase.ticks);
            } else {
                seen.fresh = false;
            }
        }
        end(phase);
    }

    /// Hands over what was prepared in `buffer.own()`.
    template <class Buffer>
    void write_in_place(Phase phase, Buffer& buffer, std::uint16_t channel, bool ready) {
        if (!may_write(phase, channel, ready, [&]() -> decltype(auto) { return buffer.own(); })) {
            return;
        }
        begin(phase);
        {
            auto writing = buffer.write(cycle_.watchdog);
            task_.pace.spend(phase.ticks);
            writing.publish();
        }
        end(phase);
    }

    /// Moves what was prepared in `staged` into the channel's array, holding the lock.
    template <class Buffer, class T>
    void write_copy(Phase phase, Buffer& buffer, T& staged, std::uint16_t channel, bool ready) {
        if (!may_write(phase, channel, ready, [&]() -> const T& { return staged; })) {
            return;
        }
        begin(phase);
        if (auto writing = buffer.write(cycle_.watchdog)) {
            move_over(staged, *writing);
            task_.pace.spend(phase.ticks);
            writing.publish();
        }
        end(phase);
    }

    /// Sends what was prepared in `staged`; waits for room in a full queue within the watchdog.
    template <class Queue, class T>
    void send(Phase phase, Queue& queue, Message<T>& staged, std::uint16_t channel, bool ready) {
        if (!may_write(phase, channel, ready, [&]() -> const T& { return staged.datum; })) {
            return;
        }
        begin(phase);
        task_.pace.spend(1);
        staged.stamp_ns = cycle_.start_ns;
        if constexpr (std::is_copy_assignable_v<T>) {
            queue.send(staged, cycle_.watchdog);
        } else {
            queue.send(std::move(staged), cycle_.watchdog);  // a refused one stays
        }
        end(phase);
    }

    /// Takes the oldest message; if there is none, the one before stays, no longer fresh.
    template <class Queue, class T>
    void receive(Phase phase, Queue& queue, std::optional<Message<T>>& last, Seen<T>& seen) {
        begin(phase);
        seen.fresh = false;
        if (auto message = queue.receive()) {
            last = std::move(message);
            seen = {&last->datum, true, static_cast<std::uint64_t>(queue.taken()), last->stamp_ns};
            tell_new(phase, seen);
        }
        task_.pace.spend(phase.ticks);
        end(phase);
    }

    /// Publishes what was prepared in `cell.own()` at the end of the phase.
    template <class Buffer>
    void store(Phase phase, Buffer& cell, std::uint16_t channel, bool ready) {
        if (!may_write(phase, channel, ready, [&]() -> decltype(auto) { return cell.own(); })) {
            return;
        }
        begin(phase);
        task_.pace.spend(phase.ticks);
        cell.write(cycle_.watchdog).publish();
        end(phase);
    }

    /// The cycle of a synchronous task is done: in time or not. `component` is its number among the names.
    void complete(std::uint16_t component, std::int64_t now_ns) {
        const bool met = now_ns <= cycle_.deadline_ns;
        task_.done(!met);
        task_.record(met ? Kind::meets : Kind::misses, component, static_cast<std::uint64_t>(cycle_.number));
    }

  private:
    // One event for each part that is no tuple.
    template <class T>
    void values(Kind kind, std::uint16_t object, const T* value, bool fresh) {
        const bool known = value != nullptr;
        std::size_t part = 0;
        each_scalar(known ? *value : T{}, [&](const auto& scalar) {
            task_.record(kind, object, known ? bits_of(scalar) : 0, known ? 1 : 0, part++, fresh);
        });
    }

    template <class Reading, class T>
    static void show(const Reading& reading, const T* datum, Seen<T>& seen) {
        if (datum != nullptr) {
            seen = {datum, reading.fresh(), reading.sequence(), reading.stamp_ns()};
        }
    }

    // Returns when that is.
    std::int64_t begin(Phase phase) {
        task_.progress(phase.number);
        task_.record(Kind::begins, phase.number, static_cast<std::uint64_t>(cycle_.number));
        return task_.instant_ns();
    }

    void end(Phase phase) {
        task_.ways_end_phase(phase.number);
        task_.record(Kind::ends, phase.number, static_cast<std::uint64_t>(cycle_.number));
    }

    template <class T>
    void tell_new(Phase phase, const Seen<T>& seen) noexcept {
        if (seen && seen.fresh) {
            task_.read_new(phase.number);
        }
    }

    template <class Staged>
    bool may_write(Phase phase, std::uint16_t channel, bool ready, Staged&& staged) {
        if (ready && is_valid(staged())) {
            return true;
        }
        if (ready) {
            task_.count_invalid();
            task_.record(Kind::invalid, channel);
        }
        task_.record(Kind::passes, phase.number, static_cast<std::uint64_t>(cycle_.number));
        return false;
    }

    TaskContext<C>& task_;
    const Cycle& cycle_;
};

}  // namespace groundstate
