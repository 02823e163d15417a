// What a generated task carries with it: its log, its pace, its progress; and the observer of its channels.
//
// In: actions of the task and of the channels it uses. Out: events in its log, time spent in virtual time, and the
// instant of the last progress, by which the supervisor knows a task that hangs. Without a log nothing is recorded: what
// is left is one branch an event.
#pragma once

#include <deque>

#include "bounds.hpp"
#include "event.hpp"
#include "observer.hpp"
#include "pace.hpp"
#include "recorder.hpp"

namespace groundstate {

/// The fault that a test has put in. Compiled in only where GROUNDSTATE_SEEDED_FAULTS is defined.
#ifdef GROUNDSTATE_SEEDED_FAULTS
inline Fault seeded_fault = Fault::none;
inline bool is_seeded(Fault fault) noexcept { return fault == seeded_fault; }
#else
constexpr bool is_seeded(Fault) noexcept { return false; }
#endif

/// A task's own things. Its thread alone uses them, but for the counters.
template <Clock C>
class TaskContext {
  public:
    TaskContext(C& clock, const Pacing& pacing, std::uint16_t number)
        : pace{clock, pacing, number}, clock_{clock}, tick_ns_{pacing.tick_ns}, number_{number} {}

    /// Before the tasks start.
    void record_to(TaskLog* log, std::int64_t origin_ns) noexcept {
        log_ = log;
        origin_ns_ = origin_ns;
    }

    void record(Kind kind, std::uint16_t object, std::uint64_t number = 0, std::size_t array = 0, std::size_t next = 0,
                bool fresh = false) noexcept {
        if (log_ != nullptr) {
            log_->record({.time_ns = 0, .number = number, .order = 0, .object = object,
                          .kind = kind, .array = static_cast<std::uint8_t>(array),
                          .next = static_cast<std::uint8_t>(next), .fresh = fresh},
                         [this] { return clock_.now_ns() - origin_ns_; });
        }
    }

    /// The task is at work, and has come so far. `at` names the phase.
    void progress(std::uint16_t at) noexcept {
        phase_.set(at);
        progress_ns_.set(clock_.now_ns());
    }
    void at_rest() noexcept { progress_ns_.set(never_ns); }

    // Who: any thread.
    /// The instant of the last progress; `never_ns` while the task rests.
    std::int64_t progress_ns() const noexcept { return progress_ns_.value(); }
    std::uint16_t phase() const noexcept { return static_cast<std::uint16_t>(phase_.value()); }
    std::int64_t cycle() const noexcept { return cycle_.value(); }
    std::int64_t invalid() const noexcept { return invalid_.value(); }

    std::uint16_t number() const noexcept { return number_; }
    void count_invalid() noexcept { invalid_.add(); }
    void begin_cycle(std::int64_t number) noexcept { cycle_.set(number); }

    /// Now, as deadlines and bounds see it: in modelled time the present tick.
    std::int64_t instant_ns() const noexcept {
        const std::int64_t now_ns = clock_.now_ns();
        return pace.is_modelled() ? now_ns - now_ns % tick_ns_ : now_ns;
    }

    /// A bound that this task counts, and a way that it is on. Who: the builder of the system. Allocates: yes.
    void count(const BoundPlan& bound) { bounds_.emplace_back(bound, tick_ns_); }
    void is_on(Way& way) { ways_.push_back(&way); }
    /// Who: the owner, after the task has ended; `account` any thread.
    std::deque<Bound>& bounds() noexcept { return bounds_; }
    const std::deque<Bound>& bounds() const noexcept { return bounds_; }

    // What the task does, for its bounds. Block: no. Allocate: no.
    void released(const std::int64_t late_ns) noexcept {
        each(Bounded::release, [&](Bound& bound) { bound.saw(late_ns); });
    }
    void elaborated(std::uint16_t phase, std::int64_t length_ns) noexcept {
        for (Bound& bound : bounds_) {
            if (bound.is(Bounded::elaboration, phase)) {
                bound.saw(length_ns);
            }
        }
    }
    void read_new(std::uint16_t phase) noexcept {
        for (Bound& bound : bounds_) {
            if (bound.is(Bounded::reading, phase)) {
                bound.saw_new(instant_ns());
            }
        }
    }
    void done(bool is_late) noexcept {
        each(Bounded::misses, [&](Bound& bound) { bound.saw_cycle(is_late); });
    }
    void ways_begin() noexcept {
        for (Way* way : ways_) {
            way->begins(number_, instant_ns());
        }
    }
    void ways_end_phase(std::uint16_t phase) noexcept {
        for (Way* way : ways_) {
            way->ends_phase(number_, phase);
        }
    }
    void ways_end() noexcept {
        for (Way* way : ways_) {
            way->ends_cycle(number_, instant_ns());
        }
    }
    void writes_datum(std::uint16_t channel, std::uint64_t number) noexcept {
        for (Way* way : ways_) {
            way->writes(channel, number);
        }
    }
    void reads_datum(std::uint16_t channel, std::uint64_t number) noexcept {
        for (Way* way : ways_) {
            way->reads(channel, number);
        }
    }

    TaskPace<C> pace;

  private:
    template <class Count>
    void each(Bounded kind, Count&& count) noexcept {
        for (Bound& bound : bounds_) {
            if (bound.is(kind)) {
                count(bound);
            }
        }
    }

    C& clock_;
    std::int64_t tick_ns_;
    std::uint16_t number_;
    TaskLog* log_ = nullptr;
    std::int64_t origin_ns_ = 0;
    Counter progress_ns_{never_ns};
    Counter phase_{};
    Counter cycle_{};
    Counter invalid_{};
    std::deque<Bound> bounds_{};
    std::vector<Way*> ways_{};
};

/// The observer of a channel between two generated tasks.
template <Clock C>
class Observation {
  public:
    /// `urgent` is the side that goes first when both ask in one step.
    Observation(std::uint16_t channel, TaskContext<C>& producer, TaskContext<C>& consumer, Side master, Side urgent) noexcept
        : channel_{channel}, producer_{&producer}, consumer_{&consumer}, master_{master}, urgent_{urgent} {}

    void asks(Side side) noexcept {
        of(side).pace.ask(side == urgent_);
        of(side).record(Kind::asks, channel_);
    }
    void enters(Side side) noexcept {
        of(side).pace.enter();
        of(side).record(Kind::enters, channel_);
    }
    void gives_up(Side side) noexcept {
        of(side).pace.enter();
        of(side).record(Kind::gives_up, channel_);
    }
    void releases(Side side) noexcept {
        of(side).pace.release();
        of(side).record(Kind::releases, channel_);
    }
    void swaps(std::size_t read, std::size_t write, std::uint64_t number) noexcept {
        of(master_).record(Kind::swaps, channel_, number, read, write);
    }
    void managed() noexcept { of(master_).pace.managed(); }
    void writes(std::size_t array, std::uint64_t number) noexcept {
        producer_->writes_datum(channel_, number);
        producer_->record(Kind::writes, channel_, number, array);
    }
    bool offers() noexcept { return producer_->pace.offer(); }
    void reads(std::size_t array, std::uint64_t number, bool fresh) noexcept {
        consumer_->reads_datum(channel_, number);
        consumer_->record(Kind::reads, channel_, number, array, 0, fresh);
    }
    void looks() noexcept { producer_->pace.look(); }
    void sends(std::uint64_t number) noexcept {
        producer_->pace.hand_over();
        producer_->writes_datum(channel_, number);
        producer_->record(Kind::sends, channel_, number);
    }
    void refuses() noexcept { producer_->record(Kind::refuses, channel_); }
    void takes(std::uint64_t number) noexcept {
        consumer_->pace.take();
        if (number != 0) {
            consumer_->reads_datum(channel_, number);
        }
        consumer_->record(Kind::takes, channel_, number);
    }
    void stores(std::uint64_t number) noexcept {
        producer_->pace.hand_over();
        producer_->writes_datum(channel_, number);
        producer_->record(Kind::stores, channel_, number);
    }
    void loads(std::uint64_t number, bool fresh) noexcept {
        consumer_->reads_datum(channel_, number);
        consumer_->record(Kind::loads, channel_, number, 0, 0, fresh);
    }
    static bool seeded(Fault fault) noexcept { return is_seeded(fault); }

  private:
    TaskContext<C>& of(Side side) noexcept { return side == Side::producer ? *producer_ : *consumer_; }

    std::uint16_t channel_;
    TaskContext<C>* producer_;
    TaskContext<C>* consumer_;
    Side master_;
    Side urgent_;
};

}  // namespace groundstate
