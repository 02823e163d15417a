// Made from ControllerSystem.chart by `groundstate generate cpp`; do not edit. What components do by their machines.
#pragma once

#include <utility>

#include <groundstate/component.hpp>

#include "controller_system.hpp"
#include "machines/arm.hpp"
#include "machines/servoing.hpp"

namespace controller_system {

/// visual_servoing as Servoing decides: one step of the machine in each `setPoint`.
class VisualServoingMachine : public VisualServoing {
  public:
    VisualServoingMachine() { groundstate::made(machine_.start(), "Servoing"); }
    bool set_point(const Cycle&, const In& in, [[maybe_unused]] Out& out) override {
        inputs_.in = &in;
        groundstate::made(machine_.step(), "Servoing");
        if (ServoMode value{}; groundstate::decided(machine_.panel(), value)) {
            out.panel = value;
        }
        if (bool value{}; groundstate::decided(machine_.guiding(), value)) {
            out.guiding = value;
        }
        return true;
    }
    /// The machine, to look at.
    const ::servoing::Machine& machine() const noexcept { return machine_; }

  private:
    struct Inputs final : ::servoing::Environment {
        decltype(std::declval<::servoing::Environment&>().hasTarget()) hasTarget() override {
            using Answer = decltype(std::declval<::servoing::Environment&>().hasTarget());
            return in == nullptr ? Answer{} : groundstate::sensed<Answer>(in->hasTarget);
        }
        decltype(std::declval<::servoing::Environment&>().isSeen()) isSeen() override {
            using Answer = decltype(std::declval<::servoing::Environment&>().isSeen());
            return in == nullptr ? Answer{} : groundstate::sensed<Answer>(in->isSeen);
        }
        decltype(std::declval<::servoing::Environment&>().hasLaw()) hasLaw() override {
            using Answer = decltype(std::declval<::servoing::Environment&>().hasLaw());
            return in == nullptr ? Answer{} : groundstate::sensed<Answer>(in->hasLaw);
        }
        decltype(std::declval<::servoing::Environment&>().isClose()) isClose() override {
            using Answer = decltype(std::declval<::servoing::Environment&>().isClose());
            return in == nullptr ? Answer{} : groundstate::sensed<Answer>(in->isClose);
        }
        /// The first candidate.
        std::size_t choose(std::size_t, groundstate::machine::Site) override { return 0; }

        const In* in = nullptr;
    };

    Inputs inputs_{};
    ::servoing::Machine machine_{inputs_};
};

/// robot as Arm decides: one step of the machine in each `control`.
class RobotMachine : public Robot {
  public:
    RobotMachine() { groundstate::made(machine_.start(), "Arm"); }
    bool control(const Cycle&, const In& in, [[maybe_unused]] Out& out) override {
        inputs_.in = &in;
        groundstate::made(machine_.step(), "Arm");
        if (ArmMode value{}; groundstate::decided(machine_.arm(), value)) {
            out.arm = value;
        }
        return true;
    }
    /// The machine, to look at.
    const ::arm::Machine& machine() const noexcept { return machine_; }

  private:
    struct Inputs final : ::arm::Environment {
        decltype(std::declval<::arm::Environment&>().isGuided()) isGuided() override {
            using Answer = decltype(std::declval<::arm::Environment&>().isGuided());
            return in == nullptr ? Answer{} : groundstate::sensed<Answer>(in->isGuided);
        }
        decltype(std::declval<::arm::Environment&>().isStill()) isStill() override {
            using Answer = decltype(std::declval<::arm::Environment&>().isStill());
            return in == nullptr ? Answer{} : groundstate::sensed<Answer>(in->isStill);
        }
        /// The first candidate.
        std::size_t choose(std::size_t, groundstate::machine::Site) override { return 0; }

        const In* in = nullptr;
    };

    Inputs inputs_{};
    ::arm::Machine machine_{inputs_};
};

}  // namespace controller_system
