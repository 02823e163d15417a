// The tasks of ControllerSystem.chart: six components with their hooks, seven channels, run by any clock.
//
// A hook class per component has one method an elaboration; false means that there is nothing to hand over. In virtual
// time a phase lasts as long as the chart says.
#pragma once

#include <memory>

#include <groundstate/runtime.hpp>

#include "data.hpp"

namespace controller_system {

using groundstate::Cycle;

/// The newest datum of a channel, in place.
template <class T>
struct Seen {
    const T* datum = nullptr;
    bool fresh = false;
    std::uint64_t sequence = 0;
    std::int64_t stamp_ns = 0;
    explicit operator bool() const noexcept { return datum != nullptr; }
    const T& operator*() const noexcept { return *datum; }
    const T* operator->() const noexcept { return datum; }
};

struct Operator {
    struct In {};
    struct Out {
        Targets& targets;
    };
    virtual ~Operator() = default;
    virtual bool plan(const Cycle&, const In&, Out&) = 0;
};

struct Camera {
    struct In {};
    struct Out {
        CameraToVs& camera_to_vs;
    };
    virtual ~Camera() = default;
    virtual bool grab(const Cycle&, const In&, Out&) = 0;
};

struct VisualServoing {
    struct In {
        Seen<Targets> targets;
        Seen<CameraToVs> camera_to_vs;
        Seen<RobotToVs> robot_to_vs;
    };
    struct Out {
        VsToRobot& vs_to_robot;
    };
    virtual ~VisualServoing() = default;
    virtual bool set_point(const Cycle&, const In&, Out&) = 0;
};

struct Robot {
    struct In {
        Seen<VsToRobot> vs_to_robot;
        Seen<EncoderToRobot> encoder_to_robot;
    };
    struct Out {
        RobotToMotor& robot_to_motor;
        RobotToVs& robot_to_vs;
    };
    virtual ~Robot() = default;
    virtual bool control(const Cycle&, const In&, Out&) = 0;
};

struct Motor {
    struct In {
        Seen<EncoderToMotor> encoder_to_motor;
        Seen<RobotToMotor> robot_to_motor;
    };
    struct Out {};
    virtual ~Motor() = default;
    virtual bool drive(const Cycle&, const In&, Out&) = 0;
};

struct Encoder {
    struct In {};
    struct Out {
        EncoderToRobot& encoder_to_robot;
        EncoderToMotor& encoder_to_motor;
    };
    virtual ~Encoder() = default;
    virtual bool acquire(const Cycle&, const In&, Out&) = 0;
};

struct Hooks {
    Operator& operator_;
    Camera& camera;
    VisualServoing& visual_servoing;
    Robot& robot;
    Motor& motor;
    Encoder& encoder;
};

template <groundstate::Clock C>
class ControllerSystem {
  public:
    static constexpr std::size_t threads = 7;

    ControllerSystem(C& clock, const Hooks& hooks) : clock_{clock}, hooks_{hooks} {
        camera_to_vs_.wakes(servoing_.trigger());
    }

    template <class What>
    void each(What&& what) {
        what(operator_), what(camera_), what(servoing_), what(robot_), what(motor_), what(encoder_);
    }

    void run(std::int64_t span_ns) {
        const std::int64_t origin_ns = clock_.now_ns();
        operator_.start(origin_ns);
        camera_.start(origin_ns);
        servoing_.start();
        robot_.start(origin_ns);
        motor_.start(origin_ns);
        encoder_.start(origin_ns);
        clock_.enter(-1);
        clock_.sleep_until_ns(origin_ns + span_ns);
        each([](auto& task) { task.ask_to_stop(); });
        clock_.leave();
        each([](auto& task) { task.stop(); });
    }

  private:
    static constexpr std::int64_t us = 1'000;
    static constexpr std::int64_t ms = 1'000'000;
    template <class T>
    using Buffer = groundstate::WaitFreeBuffer<T, 3, C>;
    using Periodic = groundstate::PeriodicTask<C>;

    void spend(std::int64_t span_ns) noexcept {
        if constexpr (std::is_same_v<C, groundstate::VirtualClock>) {
            clock_.sleep_until_ns(clock_.now_ns() + span_ns);
        }
    }

    template <class Reading>
    static auto seen(const Reading& reading) {
        Seen<typename Reading::Datum> result;
        if (reading) {
            result = {&*reading, reading.fresh(), reading.sequence(), reading.stamp_ns()};
        }
        return result;
    }

    void operate(const Cycle& cycle) {
        Targets targets;
        Operator::Out out{targets};
        const bool ready = hooks_.operator_.plan(cycle, {}, out);
        if (ready) {
            targets_.send(targets, cycle.watchdog);
        }
    }

    void film(const Cycle& cycle) {
        auto image = camera_to_vs_.write(cycle.watchdog);
        Camera::Out out{*image};
        if (hooks_.camera.grab(cycle, {}, out)) {
            spend(6 * ms);
            image.publish();
        }
    }

    void servo(const Cycle& cycle) {
        VisualServoing::In in;
        if (auto message = targets_.receive()) {
            last_target_ = *message;
            in.targets.fresh = true;
            has_target_ = true;
        }
        in.targets.datum = has_target_ ? &last_target_ : nullptr;
        const auto image = camera_to_vs_.read(cycle.watchdog);
        const auto robot = robot_to_vs_.read(cycle.watchdog);
        in.camera_to_vs = seen(image);
        in.robot_to_vs = seen(robot);
        auto set_point = vs_to_robot_.write(cycle.watchdog);
        VisualServoing::Out out{*set_point};
        const bool ready = hooks_.visual_servoing.set_point(cycle, in, out);
        spend(12 * ms);
        if (ready) {
            set_point.publish();
        }
    }

    void move(const Cycle& cycle) {
        const auto twist = vs_to_robot_.read(cycle.watchdog);
        const auto encoders = encoder_to_robot_.read(cycle.watchdog);
        auto motor = robot_to_motor_.write(cycle.watchdog);
        auto servoing = robot_to_vs_.write(cycle.watchdog);
        Robot::Out out{*motor, *servoing};
        const bool ready = hooks_.robot.control(cycle, {seen(twist), seen(encoders)}, out);
        spend(2 * ms);
        if (ready) {
            motor.publish();
            servoing.publish();
        }
    }

    void turn(const Cycle& cycle) {
        const auto encoders = encoder_to_motor_.read(cycle.watchdog);
        const auto robot = robot_to_motor_.read(cycle.watchdog);
        Motor::Out out;
        (void)hooks_.motor.drive(cycle, {seen(encoders), seen(robot)}, out);
        spend(300 * us);
    }

    void measure(const Cycle& cycle) {
        auto robot = encoder_to_robot_.write(cycle.watchdog);
        auto motor = encoder_to_motor_.write(cycle.watchdog);
        Encoder::Out out{*robot, *motor};
        const bool ready = hooks_.encoder.acquire(cycle, {}, out);
        spend(100 * us);
        if (ready) {
            robot.publish();
            motor.publish();
        }
    }

    C& clock_;
    Hooks hooks_;
    groundstate::MessageQueue<Targets, 4, C> targets_{clock_};
    Targets last_target_{};
    bool has_target_ = false;
    Buffer<CameraToVs> camera_to_vs_{clock_};
    Buffer<RobotToVs> robot_to_vs_{clock_};
    Buffer<VsToRobot> vs_to_robot_{clock_};
    Buffer<EncoderToRobot> encoder_to_robot_{clock_};
    Buffer<EncoderToMotor> encoder_to_motor_{clock_};
    Buffer<RobotToMotor> robot_to_motor_{clock_};
    Periodic operator_{clock_, "operator", {.period_ns = 30 * ms}, [this](const Cycle& c) { operate(c); }, {.rank = 5}};
    Periodic camera_{clock_, "camera", {.period_ns = 10 * ms, .elaboration_ns = 6 * ms},
                     [this](const Cycle& c) { film(c); }, {.rank = 3}};
    groundstate::AsynchronousTask<C> servoing_{clock_, "visual_servoing", 100 * ms,
                                               [this] { return camera_to_vs_.available(); },
                                               [this](const Cycle& c) { servo(c); }, {.rank = 4}};
    Periodic robot_{clock_, "robot", {.period_ns = 5 * ms, .elaboration_ns = 2 * ms},
                    [this](const Cycle& c) { move(c); }, {.rank = 2}};
    Periodic motor_{clock_, "motor", {.period_ns = ms, .elaboration_ns = 300 * us},
                    [this](const Cycle& c) { turn(c); }, {.rank = 1}};
    Periodic encoder_{clock_, "encoder", {.period_ns = 500 * us, .elaboration_ns = 100 * us},
                      [this](const Cycle& c) { measure(c); }, {.rank = 0}};
};

}  // namespace controller_system
