// Made from AssemblySystem.chart by `groundstate generate cpp`; do not edit. Your code is in data.hpp and one file a component.
//
// Where the data lie while a component elaborates:
//   image: in the array of aligner, the master; microscope, who holds the lock to write, brings a copy
//   recipe: messages, copied in and out
//   correction: in the array of aligner, the master; stage, who holds the lock to read, reads a copy
//   contact: in the array of stage, the master; force, who holds the lock to write, brings a copy
//   scale: in the array of stage, the master; scales_reader, who holds the lock to write, brings a copy
//   axis_order: in the array of stage, the master; piezo, who holds the lock to read, reads a copy
//   state: in the array of supervisor, the master; stage, who holds the lock to write, brings a copy
#pragma once

#include <groundstate/program.hpp>

#include "../data.hpp"

namespace assembly_system {

using groundstate::Cycle;
using groundstate::Seen;

/// Microscope controller: every 20 ms.
struct Microscope {
    struct In {
    };
    struct Out {
        Image& image;
    };
    virtual ~Microscope() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 8 ms.
    virtual bool grab(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Aligner: when there is something new in image.
struct Aligner {
    struct In {
        Seen<Recipe> recipe{};
        Seen<Image> image{};
    };
    struct Out {
        Correction& correction;
    };
    virtual ~Aligner() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 9 ms.
    virtual bool compare(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Force controller: every 1 ms.
struct Force {
    struct In {
    };
    struct Out {
        Contact& contact;
    };
    virtual ~Force() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.2 ms.
    virtual bool feel(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Stage controller: every 2 ms.
struct Stage {
    struct In {
        Seen<Correction> correction{};
        Seen<Contact> contact{};
        Seen<Scale> scale{};
    };
    struct Out {
        AxisOrder& axis_order;
        State& state;
    };
    virtual ~Stage() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.3 ms.
    virtual bool approach(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Axis controller: every 0.5 ms.
struct Piezo {
    struct In {
        Seen<AxisOrder> axis_order{};
    };
    struct Out {
    };
    virtual ~Piezo() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.1 ms.
    virtual bool drive(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Scale controller: every 1 ms.
struct ScalesReader {
    struct In {
    };
    struct Out {
        Scale& scale;
    };
    virtual ~ScalesReader() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.1 ms.
    virtual bool acquire(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Supervisor: when there is something new in state.
struct Supervisor {
    struct In {
        Seen<State> state{};
    };
    struct Out {
        Recipe& recipe;
    };
    virtual ~Supervisor() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 5 ms.
    virtual bool decide(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// The user's code. It must outlive the system.
struct Hooks {
    Microscope& microscope;
    Aligner& aligner;
    Force& force;
    Stage& stage;
    Piezo& piezo;
    ScalesReader& scales_reader;
    Supervisor& supervisor;
};

inline groundstate::SystemPlan plan() {
    return {
        .name = "assemblySystem",
        .tick_ns = 100000,
        .tasks = {
            {.name = "microscope", .period_ticks = 200, .offset_ticks = 0, .deadline_ticks = 200, .busy_ticks = 82, .rank = 4, .single_phase = false},
            {.name = "aligner", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 97, .rank = 5, .single_phase = false, .awaits = "image"},
            {.name = "force", .period_ticks = 10, .offset_ticks = 0, .deadline_ticks = 10, .busy_ticks = 4, .rank = 1, .single_phase = false},
            {.name = "stage", .period_ticks = 20, .offset_ticks = 0, .deadline_ticks = 20, .busy_ticks = 16, .rank = 3, .single_phase = false},
            {.name = "piezo", .period_ticks = 5, .offset_ticks = 0, .deadline_ticks = 5, .busy_ticks = 3, .rank = 0, .single_phase = false},
            {.name = "scales_reader", .period_ticks = 10, .offset_ticks = 0, .deadline_ticks = 10, .busy_ticks = 3, .rank = 2, .single_phase = false},
            {.name = "supervisor", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 54, .rank = 6, .single_phase = false, .awaits = "state"},
        },
        .names = {"microscope_grab", "microscope_write", "aligner_receive", "aligner_read_image", "aligner_elaborate", "aligner_write", "force_elaborate", "force_write", "stage_read_correction", "stage_read_contact", "stage_read_scale", "stage_elaborate", "stage_write_axes", "stage_write_state", "piezo_read", "piezo_elaborate", "scales_acquire", "scales_write", "supervisor_read", "supervisor_elaborate", "supervisor_send", "image", "recipe", "correction", "contact", "scale", "axis_order", "state", "microscope", "aligner", "force", "stage", "piezo", "scales_reader", "supervisor"},
        .wait_free = {},
        .safe_stop = {4, 0, 1, 2, 3, 5, 6},
    };
}

/// Assembly under a microscope. Built before its tasks start; see `run` of the base class.
template <groundstate::Clock C>
class System final : public groundstate::SystemBase<C> {
    using Base = groundstate::SystemBase<C>;
    using Side = groundstate::Side;
    using Phases = groundstate::Phases<C>;
    using Observer = groundstate::Observation<C>;

  public:
    /// The number of threads that use its clock: the tasks, and the one that runs the system.
    static constexpr std::size_t threads = 8;

    System(C& clock, const Hooks& hooks, const groundstate::Options& options)
        : Base{clock, plan(), options}, hooks_{hooks} {
        image_channel_.wakes(aligner_task_.trigger());
        state_channel_.wakes(supervisor_task_.trigger());
        this->add(microscope_task_);
        this->add(aligner_task_);
        this->add(force_task_);
        this->add(stage_task_);
        this->add(piezo_task_);
        this->add(scales_reader_task_);
        this->add(supervisor_task_);
    }

    // Who: everybody, for what may be asked at any time; before the tasks start, to prepare them.
    auto& image_channel() noexcept { return image_channel_; }
    auto& recipe_channel() noexcept { return recipe_channel_; }
    auto& correction_channel() noexcept { return correction_channel_; }
    auto& contact_channel() noexcept { return contact_channel_; }
    auto& scale_channel() noexcept { return scale_channel_; }
    auto& axis_order_channel() noexcept { return axis_order_channel_; }
    auto& state_channel() noexcept { return state_channel_; }

  private:
    void start_component(std::size_t number) override {
        switch (number) {
            case 0: hooks_.microscope.start(); break;
            case 1: hooks_.aligner.start(); break;
            case 2: hooks_.force.start(); break;
            case 3: hooks_.stage.start(); break;
            case 4: hooks_.piezo.start(); break;
            case 5: hooks_.scales_reader.start(); break;
            case 6: hooks_.supervisor.start(); break;
            default: break;
        }
    }

    void safe_stop_component(std::size_t number) noexcept override {
        switch (number) {
            case 0: hooks_.microscope.safe_stop(); break;
            case 1: hooks_.aligner.safe_stop(); break;
            case 2: hooks_.force.safe_stop(); break;
            case 3: hooks_.stage.safe_stop(); break;
            case 4: hooks_.piezo.safe_stop(); break;
            case 5: hooks_.scales_reader.safe_stop(); break;
            case 6: hooks_.supervisor.safe_stop(); break;
            default: break;
        }
    }

    void microscope_cycle(const Cycle& cycle) {
        this->cycle(0, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({0, 80}, [&] {
                typename Microscope::Out out{image_staged_};
                return hooks_.microscope.grab(cycle, microscope_in_, out);
            });
            phases.write_copy({1, 1}, image_channel_, image_staged_, 21, ready);
            phases.complete(28, this->instant_ns(0));
        });
    }

    void aligner_cycle(const Cycle& cycle) {
        this->cycle(1, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.receive({2, 1}, recipe_channel_, recipe_last_, aligner_in_.recipe);
            phases.read_in_place({3, 1}, image_channel_, aligner_in_.image);
            ready = phases.elaborate({4, 90}, [&] {
                typename Aligner::Out out{correction_channel_.own()};
                return hooks_.aligner.compare(cycle, aligner_in_, out);
            });
            phases.write_in_place({5, 1}, correction_channel_, 23, ready);
        });
    }

    void force_cycle(const Cycle& cycle) {
        this->cycle(2, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({6, 2}, [&] {
                typename Force::Out out{contact_staged_};
                return hooks_.force.feel(cycle, force_in_, out);
            });
            phases.write_copy({7, 1}, contact_channel_, contact_staged_, 24, ready);
            phases.complete(30, this->instant_ns(2));
        });
    }

    void stage_cycle(const Cycle& cycle) {
        this->cycle(3, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_copy({8, 1}, correction_channel_, correction_copy_, stage_in_.correction);
            phases.read_in_place({9, 1}, contact_channel_, stage_in_.contact);
            phases.read_in_place({10, 1}, scale_channel_, stage_in_.scale);
            ready = phases.elaborate({11, 3}, [&] {
                typename Stage::Out out{axis_order_channel_.own(), state_staged_};
                return hooks_.stage.approach(cycle, stage_in_, out);
            });
            phases.write_in_place({12, 1}, axis_order_channel_, 26, ready);
            phases.write_copy({13, 1}, state_channel_, state_staged_, 27, ready);
            phases.complete(31, this->instant_ns(3));
        });
    }

    void piezo_cycle(const Cycle& cycle) {
        this->cycle(4, cycle, [&](Phases& phases) {
            phases.read_copy({14, 1}, axis_order_channel_, axis_order_copy_, piezo_in_.axis_order);
            phases.elaborate({15, 1}, [&] {
                typename Piezo::Out out{};
                return hooks_.piezo.drive(cycle, piezo_in_, out);
            });
            phases.complete(32, this->instant_ns(4));
        });
    }

    void scales_reader_cycle(const Cycle& cycle) {
        this->cycle(5, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({16, 1}, [&] {
                typename ScalesReader::Out out{scale_staged_};
                return hooks_.scales_reader.acquire(cycle, scales_reader_in_, out);
            });
            phases.write_copy({17, 1}, scale_channel_, scale_staged_, 25, ready);
            phases.complete(33, this->instant_ns(5));
        });
    }

    void supervisor_cycle(const Cycle& cycle) {
        this->cycle(6, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_in_place({18, 1}, state_channel_, supervisor_in_.state);
            ready = phases.elaborate({19, 50}, [&] {
                typename Supervisor::Out out{recipe_staged_.datum};
                return hooks_.supervisor.decide(cycle, supervisor_in_, out);
            });
            phases.send({20, 1}, recipe_channel_, recipe_staged_, 22, ready);
        });
    }

    Hooks hooks_;
    groundstate::LockedBuffer<Image, 2, groundstate::Master::reader, C, Observer> image_channel_{
        this->clock(), this->observe(21, 0, 1, Side::consumer, Side::producer)};
    groundstate::MessageQueue<groundstate::Message<Recipe>, 4, C, Observer> recipe_channel_{
        this->clock(), this->observe(22, 6, 1, Side::producer, Side::producer)};
    groundstate::LockedBuffer<Correction, 3, groundstate::Master::writer, C, Observer> correction_channel_{
        this->clock(), this->observe(23, 1, 3, Side::producer, Side::consumer)};
    groundstate::LockedBuffer<Contact, 2, groundstate::Master::reader, C, Observer> contact_channel_{
        this->clock(), this->observe(24, 2, 3, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<Scale, 2, groundstate::Master::reader, C, Observer> scale_channel_{
        this->clock(), this->observe(25, 5, 3, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<AxisOrder, 2, groundstate::Master::writer, C, Observer> axis_order_channel_{
        this->clock(), this->observe(26, 3, 4, Side::producer, Side::consumer)};
    groundstate::LockedBuffer<State, 2, groundstate::Master::reader, C, Observer> state_channel_{
        this->clock(), this->observe(27, 3, 6, Side::consumer, Side::producer)};
    typename Microscope::In microscope_in_{};
    Image image_staged_{};
    typename Aligner::In aligner_in_{};
    std::optional<groundstate::Message<Recipe>> recipe_last_{};
    typename Force::In force_in_{};
    Contact contact_staged_{};
    typename Stage::In stage_in_{};
    Correction correction_copy_{};
    State state_staged_{};
    typename Piezo::In piezo_in_{};
    AxisOrder axis_order_copy_{};
    typename ScalesReader::In scales_reader_in_{};
    Scale scale_staged_{};
    typename Supervisor::In supervisor_in_{};
    groundstate::Message<Recipe> recipe_staged_{};
    groundstate::PeriodicTask<C> microscope_task_{this->clock(), "microscope", this->period(0),
        [this](const Cycle& cycle) { microscope_cycle(cycle); }, this->schedule(0)};
    groundstate::AsynchronousTask<C> aligner_task_{this->clock(), "aligner", this->lock_patience_ns(),
        [this] {
            this->task(1).pace.rest();
            return image_channel_.available();
        },
        [this](const Cycle& cycle) { aligner_cycle(cycle); }, this->schedule(1)};
    groundstate::PeriodicTask<C> force_task_{this->clock(), "force", this->period(2),
        [this](const Cycle& cycle) { force_cycle(cycle); }, this->schedule(2)};
    groundstate::PeriodicTask<C> stage_task_{this->clock(), "stage", this->period(3),
        [this](const Cycle& cycle) { stage_cycle(cycle); }, this->schedule(3)};
    groundstate::PeriodicTask<C> piezo_task_{this->clock(), "piezo", this->period(4),
        [this](const Cycle& cycle) { piezo_cycle(cycle); }, this->schedule(4)};
    groundstate::PeriodicTask<C> scales_reader_task_{this->clock(), "scales_reader", this->period(5),
        [this](const Cycle& cycle) { scales_reader_cycle(cycle); }, this->schedule(5)};
    groundstate::AsynchronousTask<C> supervisor_task_{this->clock(), "supervisor", this->lock_patience_ns(),
        [this] {
            this->task(6).pace.rest();
            return state_channel_.available();
        },
        [this](const Cycle& cycle) { supervisor_cycle(cycle); }, this->schedule(6)};
};

}  // namespace assembly_system
