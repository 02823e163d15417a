// Made from PlacingSystem.chart by `groundstate generate cpp`; do not edit. Your code is in data.hpp and one file a component.
//
// Where the data lie while a component elaborates:
//   image: in the array of vision, the master; camera, who holds the lock to write, brings a copy
//   parts: in the array of vision, the master; planner, who holds the lock to read, reads a copy
//   progress: in the array of planner, the master; robot, who holds the lock to write, brings a copy
//   moves: messages, copied in and out
//   encoder_to_robot: in the array of robot, the master; encoder, who holds the lock to write, brings a copy
//   encoder_to_motor: in the array of motor, the master; encoder, who holds the lock to write, brings a copy
//   robot_to_motor: in the array of robot, the master; motor, who holds the lock to read, reads a copy
//   jaw_order: in the array of gripper, the master; robot, who holds the lock to write, brings a copy
//   grip: in the array of gripper, the master; robot, who holds the lock to read, reads a copy
#pragma once

#include <groundstate/program.hpp>

#include "../data.hpp"

namespace placing_system {

using groundstate::Cycle;
using groundstate::Seen;

/// Camera controller: every 40 ms.
struct Camera {
    struct In {
    };
    struct Out {
        Image& image;
    };
    virtual ~Camera() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 6 ms.
    virtual bool grab(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Part finder: when there is something new in image.
struct Vision {
    struct In {
        Seen<Image> image{};
    };
    struct Out {
        Parts& parts;
    };
    virtual ~Vision() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 15 ms.
    virtual bool find(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Planner: when there is something new in progress.
struct Planner {
    struct In {
        Seen<Parts> parts{};
        Seen<Progress> progress{};
    };
    struct Out {
        Moves& moves;
    };
    virtual ~Planner() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 10 ms.
    virtual bool plan(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Robot controller: every 5 ms.
struct Robot {
    struct In {
        Seen<Moves> moves{};
        Seen<EncoderToRobot> encoder_to_robot{};
        Seen<Grip> grip{};
    };
    struct Out {
        RobotToMotor& robot_to_motor;
        JawOrder& jaw_order;
        Progress& progress;
    };
    virtual ~Robot() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 1 ms.
    virtual bool control(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Gripper controller: every 10 ms.
struct Gripper {
    struct In {
        Seen<JawOrder> jaw_order{};
    };
    struct Out {
        Grip& grip;
    };
    virtual ~Gripper() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 0.5 ms.
    virtual bool close(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Motor controller: every 1 ms.
struct Motor {
    struct In {
        Seen<EncoderToMotor> encoder_to_motor{};
        Seen<RobotToMotor> robot_to_motor{};
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
        EncoderToRobot& encoder_to_robot;
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

/// The user's code. It must outlive the system.
struct Hooks {
    Camera& camera;
    Vision& vision;
    Planner& planner;
    Robot& robot;
    Gripper& gripper;
    Motor& motor;
    Encoder& encoder;
};

inline groundstate::SystemPlan plan() {
    return {
        .name = "placingSystem",
        .tick_ns = 100000,
        .tasks = {
            {.name = "camera", .period_ticks = 400, .offset_ticks = 0, .deadline_ticks = 400, .busy_ticks = 62, .rank = 4, .single_phase = false},
            {.name = "vision", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 156, .rank = 5, .single_phase = false, .awaits = "image"},
            {.name = "planner", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 106, .rank = 6, .single_phase = false, .awaits = "progress"},
            {.name = "robot", .period_ticks = 50, .offset_ticks = 0, .deadline_ticks = 50, .busy_ticks = 23, .rank = 2, .single_phase = false},
            {.name = "gripper", .period_ticks = 100, .offset_ticks = 0, .deadline_ticks = 100, .busy_ticks = 11, .rank = 3, .single_phase = false},
            {.name = "motor", .period_ticks = 10, .offset_ticks = 0, .deadline_ticks = 10, .busy_ticks = 8, .rank = 1, .single_phase = false},
            {.name = "encoder", .period_ticks = 5, .offset_ticks = 0, .deadline_ticks = 5, .busy_ticks = 5, .rank = 0, .single_phase = false},
        },
        .names = {"camera_grab", "camera_write", "vision_read", "vision_elaborate", "vision_write", "planner_read_parts", "planner_read_progress", "planner_elaborate", "planner_send", "robot_receive", "robot_read_encoder", "robot_read_grip", "robot_elaborate", "robot_write_motor", "robot_write_jaw", "robot_write_progress", "gripper_read", "gripper_elaborate", "gripper_write", "motor_read_encoder", "motor_read_robot", "motor_elaborate", "encoder_acquire", "encoder_write_robot", "encoder_write_motor", "image", "parts", "progress", "moves", "encoder_to_robot", "encoder_to_motor", "robot_to_motor", "jaw_order", "grip", "camera", "vision", "planner", "robot", "gripper", "motor", "encoder"},
        .wait_free = {},
        .safe_stop = {4, 5, 0, 1, 2, 3, 6},
    };
}

/// Pick and place with a camera above the table. Built before its tasks start; see `run` of the base class.
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
        image_channel_.wakes(vision_task_.trigger());
        progress_channel_.wakes(planner_task_.trigger());
        this->add(camera_task_);
        this->add(vision_task_);
        this->add(planner_task_);
        this->add(robot_task_);
        this->add(gripper_task_);
        this->add(motor_task_);
        this->add(encoder_task_);
    }

    // Who: everybody, for what may be asked at any time; before the tasks start, to prepare them.
    auto& image_channel() noexcept { return image_channel_; }
    auto& parts_channel() noexcept { return parts_channel_; }
    auto& progress_channel() noexcept { return progress_channel_; }
    auto& moves_channel() noexcept { return moves_channel_; }
    auto& encoder_to_robot_channel() noexcept { return encoder_to_robot_channel_; }
    auto& encoder_to_motor_channel() noexcept { return encoder_to_motor_channel_; }
    auto& robot_to_motor_channel() noexcept { return robot_to_motor_channel_; }
    auto& jaw_order_channel() noexcept { return jaw_order_channel_; }
    auto& grip_channel() noexcept { return grip_channel_; }

  private:
    void start_component(std::size_t number) override {
        switch (number) {
            case 0: hooks_.camera.start(); break;
            case 1: hooks_.vision.start(); break;
            case 2: hooks_.planner.start(); break;
            case 3: hooks_.robot.start(); break;
            case 4: hooks_.gripper.start(); break;
            case 5: hooks_.motor.start(); break;
            case 6: hooks_.encoder.start(); break;
            default: break;
        }
    }

    void safe_stop_component(std::size_t number) noexcept override {
        switch (number) {
            case 0: hooks_.camera.safe_stop(); break;
            case 1: hooks_.vision.safe_stop(); break;
            case 2: hooks_.planner.safe_stop(); break;
            case 3: hooks_.robot.safe_stop(); break;
            case 4: hooks_.gripper.safe_stop(); break;
            case 5: hooks_.motor.safe_stop(); break;
            case 6: hooks_.encoder.safe_stop(); break;
            default: break;
        }
    }

    void camera_cycle(const Cycle& cycle) {
        this->cycle(0, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({0, 60}, [&] {
                typename Camera::Out out{image_staged_};
                return hooks_.camera.grab(cycle, camera_in_, out);
            });
            phases.write_copy({1, 1}, image_channel_, image_staged_, 25, ready);
            phases.complete(34, this->instant_ns(0));
        });
    }

    void vision_cycle(const Cycle& cycle) {
        this->cycle(1, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_in_place({2, 1}, image_channel_, vision_in_.image);
            ready = phases.elaborate({3, 150}, [&] {
                typename Vision::Out out{parts_channel_.own()};
                return hooks_.vision.find(cycle, vision_in_, out);
            });
            phases.write_in_place({4, 1}, parts_channel_, 26, ready);
        });
    }

    void planner_cycle(const Cycle& cycle) {
        this->cycle(2, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_copy({5, 1}, parts_channel_, parts_copy_, planner_in_.parts);
            phases.read_in_place({6, 1}, progress_channel_, planner_in_.progress);
            ready = phases.elaborate({7, 100}, [&] {
                typename Planner::Out out{moves_staged_.datum};
                return hooks_.planner.plan(cycle, planner_in_, out);
            });
            phases.send({8, 1}, moves_channel_, moves_staged_, 28, ready);
        });
    }

    void robot_cycle(const Cycle& cycle) {
        this->cycle(3, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.receive({9, 1}, moves_channel_, moves_last_, robot_in_.moves);
            phases.read_in_place({10, 1}, encoder_to_robot_channel_, robot_in_.encoder_to_robot);
            phases.read_copy({11, 1}, grip_channel_, grip_copy_, robot_in_.grip);
            ready = phases.elaborate({12, 10}, [&] {
                typename Robot::Out out{robot_to_motor_channel_.own(), jaw_order_staged_, progress_staged_};
                return hooks_.robot.control(cycle, robot_in_, out);
            });
            phases.write_in_place({13, 1}, robot_to_motor_channel_, 31, ready);
            phases.write_copy({14, 1}, jaw_order_channel_, jaw_order_staged_, 32, ready);
            phases.write_copy({15, 1}, progress_channel_, progress_staged_, 27, ready);
            phases.complete(37, this->instant_ns(3));
        });
    }

    void gripper_cycle(const Cycle& cycle) {
        this->cycle(4, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_in_place({16, 1}, jaw_order_channel_, gripper_in_.jaw_order);
            ready = phases.elaborate({17, 5}, [&] {
                typename Gripper::Out out{grip_channel_.own()};
                return hooks_.gripper.close(cycle, gripper_in_, out);
            });
            phases.write_in_place({18, 1}, grip_channel_, 33, ready);
            phases.complete(38, this->instant_ns(4));
        });
    }

    void motor_cycle(const Cycle& cycle) {
        this->cycle(5, cycle, [&](Phases& phases) {
            phases.read_in_place({19, 1}, encoder_to_motor_channel_, motor_in_.encoder_to_motor);
            phases.read_copy({20, 1}, robot_to_motor_channel_, robot_to_motor_copy_, motor_in_.robot_to_motor);
            phases.elaborate({21, 3}, [&] {
                typename Motor::Out out{};
                return hooks_.motor.drive(cycle, motor_in_, out);
            });
            phases.complete(39, this->instant_ns(5));
        });
    }

    void encoder_cycle(const Cycle& cycle) {
        this->cycle(6, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({22, 1}, [&] {
                typename Encoder::Out out{encoder_to_robot_staged_, encoder_to_motor_staged_};
                return hooks_.encoder.acquire(cycle, encoder_in_, out);
            });
            phases.write_copy({23, 1}, encoder_to_robot_channel_, encoder_to_robot_staged_, 29, ready);
            phases.write_copy({24, 1}, encoder_to_motor_channel_, encoder_to_motor_staged_, 30, ready);
            phases.complete(40, this->instant_ns(6));
        });
    }

    Hooks hooks_;
    groundstate::LockedBuffer<Image, 2, groundstate::Master::reader, C, Observer> image_channel_{
        this->clock(), this->observe(25, 0, 1, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<Parts, 3, groundstate::Master::writer, C, Observer> parts_channel_{
        this->clock(), this->observe(26, 1, 2, Side::producer, Side::producer)};
    groundstate::LockedBuffer<Progress, 2, groundstate::Master::reader, C, Observer> progress_channel_{
        this->clock(), this->observe(27, 3, 2, Side::consumer, Side::producer)};
    groundstate::MessageQueue<groundstate::Message<Moves>, 4, C, Observer> moves_channel_{
        this->clock(), this->observe(28, 2, 3, Side::producer, Side::consumer)};
    groundstate::LockedBuffer<EncoderToRobot, 2, groundstate::Master::reader, C, Observer> encoder_to_robot_channel_{
        this->clock(), this->observe(29, 6, 3, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<EncoderToMotor, 2, groundstate::Master::reader, C, Observer> encoder_to_motor_channel_{
        this->clock(), this->observe(30, 6, 5, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<RobotToMotor, 2, groundstate::Master::writer, C, Observer> robot_to_motor_channel_{
        this->clock(), this->observe(31, 3, 5, Side::producer, Side::consumer)};
    groundstate::LockedBuffer<JawOrder, 2, groundstate::Master::reader, C, Observer> jaw_order_channel_{
        this->clock(), this->observe(32, 3, 4, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<Grip, 2, groundstate::Master::writer, C, Observer> grip_channel_{
        this->clock(), this->observe(33, 4, 3, Side::producer, Side::consumer)};
    typename Camera::In camera_in_{};
    Image image_staged_{};
    typename Vision::In vision_in_{};
    typename Planner::In planner_in_{};
    Parts parts_copy_{};
    groundstate::Message<Moves> moves_staged_{};
    typename Robot::In robot_in_{};
    std::optional<groundstate::Message<Moves>> moves_last_{};
    Grip grip_copy_{};
    JawOrder jaw_order_staged_{};
    Progress progress_staged_{};
    typename Gripper::In gripper_in_{};
    typename Motor::In motor_in_{};
    RobotToMotor robot_to_motor_copy_{};
    typename Encoder::In encoder_in_{};
    EncoderToRobot encoder_to_robot_staged_{};
    EncoderToMotor encoder_to_motor_staged_{};
    groundstate::PeriodicTask<C> camera_task_{this->clock(), "camera", this->period(0),
        [this](const Cycle& cycle) { camera_cycle(cycle); }, this->schedule(0)};
    groundstate::AsynchronousTask<C> vision_task_{this->clock(), "vision", this->lock_patience_ns(),
        [this] {
            this->task(1).pace.rest();
            return image_channel_.available();
        },
        [this](const Cycle& cycle) { vision_cycle(cycle); }, this->schedule(1)};
    groundstate::AsynchronousTask<C> planner_task_{this->clock(), "planner", this->lock_patience_ns(),
        [this] {
            this->task(2).pace.rest();
            return progress_channel_.available();
        },
        [this](const Cycle& cycle) { planner_cycle(cycle); }, this->schedule(2)};
    groundstate::PeriodicTask<C> robot_task_{this->clock(), "robot", this->period(3),
        [this](const Cycle& cycle) { robot_cycle(cycle); }, this->schedule(3)};
    groundstate::PeriodicTask<C> gripper_task_{this->clock(), "gripper", this->period(4),
        [this](const Cycle& cycle) { gripper_cycle(cycle); }, this->schedule(4)};
    groundstate::PeriodicTask<C> motor_task_{this->clock(), "motor", this->period(5),
        [this](const Cycle& cycle) { motor_cycle(cycle); }, this->schedule(5)};
    groundstate::PeriodicTask<C> encoder_task_{this->clock(), "encoder", this->period(6),
        [this](const Cycle& cycle) { encoder_cycle(cycle); }, this->schedule(6)};
};

}  // namespace placing_system
