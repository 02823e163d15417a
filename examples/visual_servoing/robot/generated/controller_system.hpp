// Made from ControllerSystem.chart by `groundstate generate cpp`; do not edit. Your code is in data.hpp and one file a component.
//
// Where the data lie while a component elaborates:
//   targets: messages, copied in and out
//   camera_to_vs: in the array of visual_servoing, the master; camera, who holds the lock to write, brings a copy
//   robot_to_vs: in the array of visual_servoing, the master; robot, who holds the lock to write, brings a copy
//   vs_to_robot: in the array of visual_servoing, the master; robot, who holds the lock to read, reads a copy
//   encoder_to_robot: in the array of robot, the master; encoder, who holds the lock to write, brings a copy
//   encoder_to_motor: in the array of motor, the master; encoder, who holds the lock to write, brings a copy
//   robot_to_motor: in the array of robot, the master; motor, who holds the lock to read, reads a copy
#pragma once

#include <groundstate/program.hpp>

#include "messages.hpp"
#include "../data.hpp"

namespace controller_system {

using groundstate::Cycle;
using groundstate::Seen;

/// Operator: again and again.
struct Operator {
    struct In {
    };
    struct Out {
        Targets& targets;
    };
    virtual ~Operator() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 30 ms.
    virtual bool plan(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Camera controller: every 10 ms.
struct Camera {
    struct In {
    };
    struct Out {
        CameraToVs& camera_to_vs;
    };
    virtual ~Camera() = default;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 6 ms.
    virtual bool grab(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Visual servoing: when there is something new in camera_to_vs.
struct VisualServoing {
    struct In {
        Seen<Targets> targets{};
        Seen<CameraToVs> camera_to_vs{};
        Seen<RobotToVs> robot_to_vs{};
        bool hasTarget{};
        bool isSeen{};
        bool hasLaw{};
        bool isClose{};
    };
    struct Out {
        VsToRobot& vs_to_robot;
        std::optional<ServoMode>& panel;
        std::optional<bool>& guiding;
    };
    virtual ~VisualServoing() = default;
    /// Before the sensors are asked, for those that are computed of what was read.
    virtual void before_sensors(const Cycle& /*cycle*/, const In& /*in*/) {}
    /// What the sensor hasTarget says.
    virtual bool has_target(const Cycle& cycle) = 0;
    /// What the sensor isSeen says.
    virtual bool is_seen(const Cycle& cycle) = 0;
    /// What the sensor hasLaw says.
    virtual bool has_law(const Cycle& cycle) = 0;
    /// What the sensor isClose says.
    virtual bool is_close(const Cycle& cycle) = 0;
    /// Sets the actuator panel.
    virtual void panel(const Cycle& cycle, ServoMode value) = 0;
    /// Sets the actuator guiding.
    virtual void guiding(const Cycle& cycle, bool value) = 0;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 12 ms.
    virtual bool set_point(const Cycle& cycle, const In& in, Out& out) = 0;
    /// Before the tasks start; may allocate.
    virtual void start() {}
    /// After all tasks have ended, for whatever reason.
    virtual void safe_stop() noexcept {}
};

/// Robot controller: every 5 ms.
struct Robot {
    struct In {
        Seen<VsToRobot> vs_to_robot{};
        Seen<EncoderToRobot> encoder_to_robot{};
        bool isGuided{};
        bool isStill{};
    };
    struct Out {
        RobotToMotor& robot_to_motor;
        RobotToVs& robot_to_vs;
        std::optional<ArmMode>& arm;
    };
    virtual ~Robot() = default;
    /// Before the sensors are asked, for those that are computed of what was read.
    virtual void before_sensors(const Cycle& /*cycle*/, const In& /*in*/) {}
    /// What the sensor isGuided says.
    virtual bool is_guided(const Cycle& cycle) = 0;
    /// What the sensor isStill says.
    virtual bool is_still(const Cycle& cycle) = 0;
    /// Sets the actuator arm.
    virtual void arm(const Cycle& cycle, ArmMode value) = 0;
    /// Returns false if there is nothing to hand over in this cycle. Should end within 2 ms.
    virtual bool control(const Cycle& cycle, const In& in, Out& out) = 0;
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
    Operator& operator_;
    Camera& camera;
    VisualServoing& visual_servoing;
    Robot& robot;
    Motor& motor;
    Encoder& encoder;
};

inline groundstate::SystemPlan plan() {
    return {
        .name = "controllerSystem",
        .tick_ns = 100000,
        .tasks = {
            {.name = "operator", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 301, .rank = 4, .single_phase = false},
            {.name = "camera", .period_ticks = 100, .offset_ticks = 0, .deadline_ticks = 100, .busy_ticks = 62, .rank = 3, .single_phase = false},
            {.name = "visual_servoing", .period_ticks = 0, .offset_ticks = 0, .deadline_ticks = 0, .busy_ticks = 130, .rank = 5, .single_phase = false, .awaits = "camera_to_vs"},
            {.name = "robot", .period_ticks = 50, .offset_ticks = 0, .deadline_ticks = 50, .busy_ticks = 30, .rank = 2, .single_phase = false},
            {.name = "motor", .period_ticks = 10, .offset_ticks = 0, .deadline_ticks = 10, .busy_ticks = 8, .rank = 1, .single_phase = false},
            {.name = "encoder", .period_ticks = 5, .offset_ticks = 0, .deadline_ticks = 5, .busy_ticks = 5, .rank = 0, .single_phase = false},
        },
        .names = {"operator_plan", "operator_send", "camera_grab", "camera_write", "vs_receive_target", "vs_read_image", "vs_read_robot", "vs_elaborate", "vs_write", "robot_read_vs", "robot_read_encoder", "robot_elaborate", "robot_write_motor", "robot_write_vs", "motor_read_encoder", "motor_read_robot", "motor_elaborate", "encoder_acquire", "encoder_write_robot", "encoder_write_motor", "targets", "camera_to_vs", "robot_to_vs", "vs_to_robot", "encoder_to_robot", "encoder_to_motor", "robot_to_motor", "operator", "camera", "visual_servoing", "robot", "motor", "encoder", "lens", "encoders", "hasTarget", "isSeen", "hasLaw", "isClose", "isGuided", "isStill", "motors", "panel", "guiding", "arm"},
        .wait_free = {},
        .safe_stop = {2, 3, 4, 0, 1, 5},
    };
}

/// Robot controller with visual servoing. Built before its tasks start; see `run` of the base class.
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
        camera_to_vs_channel_.wakes(visual_servoing_task_.trigger());
        this->add(operator_task_);
        this->add(camera_task_);
        this->add(visual_servoing_task_);
        this->add(robot_task_);
        this->add(motor_task_);
        this->add(encoder_task_);
    }

    // Who: everybody, for what may be asked at any time; before the tasks start, to prepare them.
    auto& targets_channel() noexcept { return targets_channel_; }
    auto& camera_to_vs_channel() noexcept { return camera_to_vs_channel_; }
    auto& robot_to_vs_channel() noexcept { return robot_to_vs_channel_; }
    auto& vs_to_robot_channel() noexcept { return vs_to_robot_channel_; }
    auto& encoder_to_robot_channel() noexcept { return encoder_to_robot_channel_; }
    auto& encoder_to_motor_channel() noexcept { return encoder_to_motor_channel_; }
    auto& robot_to_motor_channel() noexcept { return robot_to_motor_channel_; }

  private:
    void start_component(std::size_t number) override {
        switch (number) {
            case 0: hooks_.operator_.start(); break;
            case 1: hooks_.camera.start(); break;
            case 2: hooks_.visual_servoing.start(); break;
            case 3: hooks_.robot.start(); break;
            case 4: hooks_.motor.start(); break;
            case 5: hooks_.encoder.start(); break;
            default: break;
        }
    }

    void safe_stop_component(std::size_t number) noexcept override {
        switch (number) {
            case 0: hooks_.operator_.safe_stop(); break;
            case 1: hooks_.camera.safe_stop(); break;
            case 2: hooks_.visual_servoing.safe_stop(); break;
            case 3: hooks_.robot.safe_stop(); break;
            case 4: hooks_.motor.safe_stop(); break;
            case 5: hooks_.encoder.safe_stop(); break;
            default: break;
        }
    }

    void operator_cycle(const Cycle& cycle) {
        this->cycle(0, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({0, 300}, [&] {
                typename Operator::Out out{targets_staged_.datum};
                return hooks_.operator_.plan(cycle, operator_in_, out);
            });
            phases.send({1, 1}, targets_channel_, targets_staged_, 20, ready);
        });
        this->rest_for_a_cycle(0, cycle);
    }

    void camera_cycle(const Cycle& cycle) {
        this->cycle(1, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({2, 60}, [&] {
                typename Camera::Out out{camera_to_vs_staged_};
                return hooks_.camera.grab(cycle, camera_in_, out);
            });
            phases.write_copy({3, 1}, camera_to_vs_channel_, camera_to_vs_staged_, 21, ready);
            phases.complete(28, this->instant_ns(1));
        });
    }

    void visual_servoing_cycle(const Cycle& cycle) {
        this->cycle(2, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.receive({4, 1}, targets_channel_, targets_last_, visual_servoing_in_.targets);
            phases.read_in_place({5, 1}, camera_to_vs_channel_, visual_servoing_in_.camera_to_vs);
            phases.read_in_place({6, 1}, robot_to_vs_channel_, visual_servoing_in_.robot_to_vs);
            ready = phases.decide({7, 120}, [&] {
                hooks_.visual_servoing.before_sensors(cycle, visual_servoing_in_);
                visual_servoing_in_.hasTarget = hooks_.visual_servoing.has_target(cycle);
                visual_servoing_in_.isSeen = hooks_.visual_servoing.is_seen(cycle);
                visual_servoing_in_.hasLaw = hooks_.visual_servoing.has_law(cycle);
                visual_servoing_in_.isClose = hooks_.visual_servoing.is_close(cycle);
                std::optional<ServoMode> set_panel{};
                std::optional<bool> set_guiding{};
                typename VisualServoing::Out out{vs_to_robot_channel_.own(), set_panel, set_guiding};
                phases.senses(35, visual_servoing_in_.hasTarget);
                phases.senses(36, visual_servoing_in_.isSeen);
                phases.senses(37, visual_servoing_in_.hasLaw);
                phases.senses(38, visual_servoing_in_.isClose);
                const bool done = hooks_.visual_servoing.set_point(cycle, visual_servoing_in_, out);
                phases.decides(42, set_panel.value_or(ServoMode{}), set_panel.has_value());
                if (set_panel) {
                    hooks_.visual_servoing.panel(cycle, *set_panel);
                }
                phases.decides(43, set_guiding.value_or(bool{}), set_guiding.has_value());
                if (set_guiding) {
                    hooks_.visual_servoing.guiding(cycle, *set_guiding);
                }
                return done;
            });
            phases.write_in_place({8, 1}, vs_to_robot_channel_, 23, ready);
        });
    }

    void robot_cycle(const Cycle& cycle) {
        this->cycle(3, cycle, [&](Phases& phases) {
            bool ready = false;
            phases.read_copy({9, 1}, vs_to_robot_channel_, vs_to_robot_copy_, robot_in_.vs_to_robot);
            phases.read_in_place({10, 1}, encoder_to_robot_channel_, robot_in_.encoder_to_robot);
            ready = phases.decide({11, 20}, [&] {
                hooks_.robot.before_sensors(cycle, robot_in_);
                robot_in_.isGuided = hooks_.robot.is_guided(cycle);
                robot_in_.isStill = hooks_.robot.is_still(cycle);
                std::optional<ArmMode> set_arm{};
                typename Robot::Out out{robot_to_motor_channel_.own(), robot_to_vs_staged_, set_arm};
                phases.senses(39, robot_in_.isGuided);
                phases.senses(40, robot_in_.isStill);
                const bool done = hooks_.robot.control(cycle, robot_in_, out);
                phases.decides(44, set_arm.value_or(ArmMode{}), set_arm.has_value());
                if (set_arm) {
                    hooks_.robot.arm(cycle, *set_arm);
                }
                return done;
            });
            phases.write_in_place({12, 1}, robot_to_motor_channel_, 26, ready);
            phases.write_copy({13, 1}, robot_to_vs_channel_, robot_to_vs_staged_, 22, ready);
            phases.complete(30, this->instant_ns(3));
        });
    }

    void motor_cycle(const Cycle& cycle) {
        this->cycle(4, cycle, [&](Phases& phases) {
            phases.read_in_place({14, 1}, encoder_to_motor_channel_, motor_in_.encoder_to_motor);
            phases.read_copy({15, 1}, robot_to_motor_channel_, robot_to_motor_copy_, motor_in_.robot_to_motor);
            phases.elaborate({16, 3}, [&] {
                typename Motor::Out out{};
                return hooks_.motor.drive(cycle, motor_in_, out);
            });
            phases.complete(31, this->instant_ns(4));
        });
    }

    void encoder_cycle(const Cycle& cycle) {
        this->cycle(5, cycle, [&](Phases& phases) {
            bool ready = false;
            ready = phases.elaborate({17, 1}, [&] {
                typename Encoder::Out out{encoder_to_robot_staged_, encoder_to_motor_staged_};
                return hooks_.encoder.acquire(cycle, encoder_in_, out);
            });
            phases.write_copy({18, 1}, encoder_to_robot_channel_, encoder_to_robot_staged_, 24, ready);
            phases.write_copy({19, 1}, encoder_to_motor_channel_, encoder_to_motor_staged_, 25, ready);
            phases.complete(32, this->instant_ns(5));
        });
    }

    Hooks hooks_;
    groundstate::MessageQueue<groundstate::Message<Targets>, 4, C, Observer> targets_channel_{
        this->clock(), this->observe(20, 0, 2, Side::producer, Side::producer)};
    groundstate::LockedBuffer<CameraToVs, 2, groundstate::Master::reader, C, Observer> camera_to_vs_channel_{
        this->clock(), this->observe(21, 1, 2, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<RobotToVs, 2, groundstate::Master::reader, C, Observer> robot_to_vs_channel_{
        this->clock(), this->observe(22, 3, 2, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<VsToRobot, 3, groundstate::Master::writer, C, Observer> vs_to_robot_channel_{
        this->clock(), this->observe(23, 2, 3, Side::producer, Side::consumer)};
    groundstate::LockedBuffer<EncoderToRobot, 2, groundstate::Master::reader, C, Observer> encoder_to_robot_channel_{
        this->clock(), this->observe(24, 5, 3, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<EncoderToMotor, 2, groundstate::Master::reader, C, Observer> encoder_to_motor_channel_{
        this->clock(), this->observe(25, 5, 4, Side::consumer, Side::producer)};
    groundstate::LockedBuffer<RobotToMotor, 2, groundstate::Master::writer, C, Observer> robot_to_motor_channel_{
        this->clock(), this->observe(26, 3, 4, Side::producer, Side::consumer)};
    typename Operator::In operator_in_{};
    groundstate::Message<Targets> targets_staged_{};
    typename Camera::In camera_in_{};
    CameraToVs camera_to_vs_staged_{};
    typename VisualServoing::In visual_servoing_in_{};
    std::optional<groundstate::Message<Targets>> targets_last_{};
    typename Robot::In robot_in_{};
    VsToRobot vs_to_robot_copy_{};
    RobotToVs robot_to_vs_staged_{};
    typename Motor::In motor_in_{};
    RobotToMotor robot_to_motor_copy_{};
    typename Encoder::In encoder_in_{};
    EncoderToRobot encoder_to_robot_staged_{};
    EncoderToMotor encoder_to_motor_staged_{};
    groundstate::AsynchronousTask<C> operator_task_{this->clock(), "operator", this->lock_patience_ns(),
        [this] {
            this->task(0).pace.rest();
            return true;
        },
        [this](const Cycle& cycle) { operator_cycle(cycle); }, this->schedule(0)};
    groundstate::PeriodicTask<C> camera_task_{this->clock(), "camera", this->period(1),
        [this](const Cycle& cycle) { camera_cycle(cycle); }, this->schedule(1)};
    groundstate::AsynchronousTask<C> visual_servoing_task_{this->clock(), "visual_servoing", this->lock_patience_ns(),
        [this] {
            this->task(2).pace.rest();
            return camera_to_vs_channel_.available();
        },
        [this](const Cycle& cycle) { visual_servoing_cycle(cycle); }, this->schedule(2)};
    groundstate::PeriodicTask<C> robot_task_{this->clock(), "robot", this->period(3),
        [this](const Cycle& cycle) { robot_cycle(cycle); }, this->schedule(3)};
    groundstate::PeriodicTask<C> motor_task_{this->clock(), "motor", this->period(4),
        [this](const Cycle& cycle) { motor_cycle(cycle); }, this->schedule(4)};
    groundstate::PeriodicTask<C> encoder_task_{this->clock(), "encoder", this->period(5),
        [this](const Cycle& cycle) { encoder_cycle(cycle); }, this->schedule(5)};
};

}  // namespace controller_system
