// Made from TrackingSystem.chart by `groundstate generate cpp`; do not edit. Your code is in data.hpp and one file a component.
//
// Where the data lie while a component elaborates:
//   image: in the array of tracker, the master; camera, who holds the lock to write, brings a copy
//   head_angles: in the array of tracker, the master; head, who holds the lock to write, brings a copy
//   track: in the array of tracker, the master; head, who holds the lock to read, reads a copy
//   sightings: messages, copied in and out
//   encoder_to_head: in the array of head, the master; encoder, who holds the lock to write, brings a copy
//   encoder_to_motor: in the array of motor, the master; encoder, who holds the lock to write, brings a copy
//   head_to_motor: in the array of head, the master; motor, who holds the lock to read, reads a copy
#pragma once

#include <groundstate/program.hpp>

#include "../data.hpp"

namespace tracking_system {

using groundstate::Cycle;
using groundstate::Seen;

/// Camera controller: every 10 ms.
struct Camera {
    struct In {
    };
    struct Out {
        Image& image;
    };
    virtual ~Camera() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 4 ms.
    virtual bool grab(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Tracker: when there is something new in image.
struct Tracker {
    struct In {
        Seen<Image> image{};
        Seen<HeadAngles> head_angles{};
    };
    struct Out {
        Track& track;
        Sightings& sightings;
    };
    virtual ~Tracker() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 5 ms.
    virtual bool locate(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Head controller: every 5 ms.
struct Head {
    struct In {
        Seen<Track> track{};
        Seen<EncoderToHead> encoder_to_head{};
    };
    struct Out {
        HeadToMotor& head_to_motor;
        HeadAngles& head_angles;
    };
    virtual ~Head() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.5 ms.
    virtual bool follow(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Motor controller: every 1 ms.
struct Motor {
    struct In {
        Seen<EncoderToMotor> encoder_to_motor{};
        Seen<HeadToMotor> head_to_motor{};
    };
    struct Out {
    };
    virtual ~Motor() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.3 ms.
    virtual bool drive(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Encoder controller: every 0.5 ms.
struct Encoder {
    struct In {
    };
    struct Out {
        EncoderToHead& encoder_to_head;
        EncoderToMotor& encoder_to_motor;
    };
    virtual ~Encoder() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.1 ms.
    virtual bool acquire(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Display: when there is something new in sightings.
struct Display {
    struct In {
        Seen<Sightings> sightings{};
    };
    struct Out {
    };
    virtual ~Display() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 5 ms.
    virtual bool show(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// The user's code. It must outlive the system.
struct Hooks {
    Camera& camera;
    Tracker& tracker;
    Head& head;
    Motor& motor;
    Encoder& encoder;
    Display& display;
};

inline groundstate::SystemPlan plan() {
    return {
        .name = "trackingSystem",
        .tick_ns = 100000,
        .tasks = {
            {.name = "camera", .period_ticks = 100, .offset_ticks = 0, .deadline_ticks = 100, .busy_ticks = 42, .rank = 3, .single_phase = false},
            {.name = "tracker", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 60, .rank = 4, .single_phase = false, .awaits = "image"},
            {.name = "head", .period_ticks = 50, .offset_ticks = 0, .deadline_ticks = 50, .busy_ticks = 15, .rank = 2, .single_phase = false},
            {.name = "motor", .period_ticks = 10, .offset_ticks = 0, .deadline_ticks = 10, .busy_ticks = 8, .rank = 1, .single_phase = false},
            {.name = "encoder", .period_ticks = 5, .offset_ticks = 0, .deadline_ticks = 5, .busy_ticks = 5, .rank = 0, .single_phase = false},
            {.name = "display", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 51, .rank = 5, .single_phase = false, .awaits = "sightings"},
        },
        .names = {"camera_grab", "camera_write", "tracker_read_image", "tracker_read_angles", "tracker_elaborate", "tracker_write", "tracker_tell", "head_read_track", "head_read_encoder", "head_elaborate", "head_write_motor", "head_write_angles", "motor_read_encoder", "motor_read_head", "motor_elaborate", "encoder_acquire", "encoder_write_head", "encoder_write_motor", "display_receive", "display_show", "image", "head_angles", "track", "sightings", "encoder_to_head", "encoder_to_motor", "head_to_motor", "camera", "tracker", "head", "motor", "encoder", "display"},
        .wait_free = {},
        .safe_stop = {3, 5, 0, 1, 2, 4},
    };
}

/// Object tracking by a pan-tilt head. Built before its tasks start; see `run` of the base class.
template <groundstate::Clock C>
class System final : public groundstate::SystemBase<C> {
    using Base = groundstate::SystemBase<C>;
    using Side = groundstate::Side;
    using Phases = groundstate::Phases<C>;
    using Observer = groundstate::Observation<C>;

  public:
    /// The number of threads that use its clock: the tasks, and the one that runs the system.
    static constexpr std::size_t threads = 7;

    System(C& clock, const Hooks& hooks, const groundstate::Options& options)
        : Base{clock, plan(), options}, hooks_{hooks} {
        image_channel_.wakes(tracker_task_.trigger());
        sightings_channel_.wakes(display_task_.trigger());
        this->add(camera_task_);
        this->add(tracker_task_);
        this->add(head_task_);
        this->add(motor_task_);
        this->add(encoder_task_);
        this->add(display_task_);
    }

    // Who: everybody, for what may be asked at any time; before the tasks start, to prepare them.
    auto& image_channel() noexcept { return image_channel_; }
    auto& head_angles_channel() noexcept { return head_angles_channel_; }
    auto& track_channel() noexcept { return track_channel_; }
    auto& sightings_channel() noexcept { return sightings_channel_; }
    auto& encoder_to_head_channel() noexcept { return encoder_to_head_channel_; }
    auto& encoder_to_motor_channel() noexcept { return encoder_to_motor_channel_; }
    auto& head_to_motor_channel() noexcept { return head_to_motor_channel_; }

  private:
    void start_component(std::size_t number) override {
        switch (number) {
            case 0: hooks_.camera.start(); break;
            case 1: hooks_.tracker.start(); break;
            case 2: hooks_.head.start(); break;
            case 3: hooks_.motor.start(); break;
            case 4: hooks_.encoder.start(); break;
            case 5: hooks_.display.start(); break;
            default: break;
        }
    }

    void safe_stop_component(std::size_t number) noexcept override {
        switch (number) {
            case 0: hooks_.camera.safe_stop(); break;
            case 1: hooks_.tracker.safe_stop(); break;
            case 2: hooks_.head.safe_stop(); break;
            case 3: hooks_.motor.safe_stop(); break;
            case 4: hooks_.encoder.safe_stop(); break;
            case 5: hooks_.display.safe_stop(); break;
            default: break;
        }
    }

    void camera_cycle(const Cycle& cycle) {
        this->cycle(0, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({0, 40}, [&] {
                typename Camera::Out out{image_staged_};
                return hooks_.camera.grab(cycle, camera_in_, out);
            });
            phases.write_copy({1, 1}, image_channel_, image_staged_, 20, ready);
            phases.complete(27, this->instant_ns(0));
        });
    }

    void tracker_cycle(const Cycle& cycle) {
        this->cycle(1, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_in_place({2, 1}, image_channel_, tracker_in_.image);
            phases.read_in_place({3, 1}, head_angles_channel_, tracker_in_.head_angles);
            ready = phases.elaborate({4, 50}, [&] {
                typename Tracker::Out out{track_channel_.own(), sightings_staged_.datum};
                return hooks_.tracker.locate(cycle, tracker_in_, out);
            });
            phases.write_in_place({5, 1}, track_channel_, 22, ready);
            phases.send({6, 1}, sightings_channel_, sightings_staged_, 23, ready);
        });
    }

    void head_cycle(const Cycle& cycle) {
        this->cycle(2, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_copy({7, 1}, track_channel_, track_copy_, head_in_.track);
            phases.read_in_place({8, 1}, encoder_to_head_channel_, head_in_.encoder_to_head);
            ready = phases.elaborate({9, 5}, [&] {
                typename Head::Out out{head_to_motor_channel_.own(), head_angles_staged_};
                return hooks_.head.follow(cycle, head_in_, out);
            });
            phases.write_in_place({10, 1}, head_to_motor_channel_, 26, ready);
            phases.write_copy({11, 1}, head_angles_channel_, head_angles_staged_, 21, ready);
            phases.complete(29, this->instant_ns(2));
        });
    }

    void motor_cycle(const Cycle& cycle) {
        this->cycle(3, cycle, [&](Phases& phases) {
            phases.read_in_place({12, 1}, encoder_to_motor_channel_, motor_in_.encoder_to_motor);
            phases.read_copy({13, 1}, head_to_motor_channel_, head_to_motor_copy_, motor_in_.head_to_motor);
            phases.elaborate({14, 3}, [&] {
                typename Motor::Out out{};
                return hooks_.motor.drive(cycle, motor_in_, out);
            });
            phases.complete(30, this->instant_ns(3));
        });
    }

    void encoder_cycle(const Cycle& cycle) {
        this->cycle(4, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({15, 1}, [&] {
                typename Encoder::Out out{encoder_to_head_staged_, encoder_to_motor_staged_};
                return hooks_.encoder.acquire(cycle, encoder_in_, out);
            });
            phases.write_copy({16, 1}, encoder_to_head_channel_, encoder_to_head_staged_, 24, ready);
            phases.write_copy({17, 1}, encoder_to_motor_channel_, encoder_to_motor_staged_, 25, ready);
            phases.complete(31, this->instant_ns(4));
        });
    }

    void display_cycle(const Cycle& cycle) {
        this->cycle(5, cycle, [&](Phases& phases) {
            phases.receive({18, 1}, sightings_channel_, sightings_last_, display_in_.sightings);
            phases.elaborate({19, 50}, [&] {
                typename Display::Out out{};
                return hooks_.display.show(cycle, display_in_, out);
            });
        });
    }

    Hooks hooks_;
    groundstate::LockedBuffer<Image, 2, groundstate::Master::reader, C, Observer> image_channel_{
        this->clock(), this->observe(20, 0, 1, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<HeadAngles, 2, groundstate::Master::reader, C, Observer> head_angles_channel_{
        this->clock(), this->observe(21, 2, 1, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<Track, 3, groundstate::Master::writer, C, Observer> track_channel_{
        this->clock(), this->observe(22, 1, 2, Side::producer, Side::consumer)};
    groundstate::MessageQueue<groundstate::Message<Sightings>, 8, C, Observer> sightings_channel_{
        this->clock(), this->observe(23, 1, 5, Side::producer, Side::producer)};
    groundstate::LockedBuffer<EncoderToHead, 2, groundstate::Master::reader, C, Observer> encoder_to_head_channel_{
        this->clock(), this->observe(24, 4, 2, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<EncoderToMotor, 2, groundstate::Master::reader, C, Observer> encoder_to_motor_channel_{
        this->clock(), this->observe(25, 4, 3, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<HeadToMotor, 2, groundstate::Master::writer, C, Observer> head_to_motor_channel_{
        this->clock(), this->observe(26, 2, 3, Side::producer, Side::consumer)};
    typename Camera::In camera_in_{};
    Image image_staged_{};
    typename Tracker::In tracker_in_{};
    groundstate::Message<Sightings> sightings_staged_{};
    typename Head::In head_in_{};
    Track track_copy_{};
    HeadAngles head_angles_staged_{};
    typename Motor::In motor_in_{};
    HeadToMotor head_to_motor_copy_{};
    typename Encoder::In encoder_in_{};
    EncoderToHead encoder_to_head_staged_{};
    EncoderToMotor encoder_to_motor_staged_{};
    typename Display::In display_in_{};
    std::optional<groundstate::Message<Sightings>> sightings_last_{};
    groundstate::PeriodicTask<C> camera_task_{this->clock(), "camera", this->period(0),
        [this](const Cycle& cycle) { camera_cycle(cycle); }, this->schedule(0)};
    groundstate::AsynchronousTask<C> tracker_task_{this->clock(), "tracker", this->lock_patience_ns(),
        [this] {
            this->task(1).pace.rest();
            return image_channel_.available();
        },
        [this](const Cycle& cycle) { tracker_cycle(cycle); }, this->schedule(1)};
    groundstate::PeriodicTask<C> head_task_{this->clock(), "head", this->period(2),
        [this](const Cycle& cycle) { head_cycle(cycle); }, this->schedule(2)};
    groundstate::PeriodicTask<C> motor_task_{this->clock(), "motor", this->period(3),
        [this](const Cycle& cycle) { motor_cycle(cycle); }, this->schedule(3)};
    groundstate::PeriodicTask<C> encoder_task_{this->clock(), "encoder", this->period(4),
        [this](const Cycle& cycle) { encoder_cycle(cycle); }, this->schedule(4)};
    groundstate::AsynchronousTask<C> display_task_{this->clock(), "display", this->lock_patience_ns(),
        [this] {
            this->task(5).pace.rest();
            return !sightings_channel_.empty();
        },
        [this](const Cycle& cycle) { display_cycle(cycle); }, this->schedule(5)};
};

}  // namespace tracking_system
