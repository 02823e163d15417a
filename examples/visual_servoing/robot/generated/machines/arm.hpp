// The machine Arm in C++, made by groundstate from Arm.asm. Overwritten by each generation.
//
// Who: one thread at a time. `start` and `step` block only where the environment does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include <groundstate/machine/boxing.hpp>
#include <groundstate/machine/elements.hpp>
#include <groundstate/machine/inputs.hpp>
#include <groundstate/machine/lists.hpp>
#include <groundstate/machine/locations.hpp>
#include <groundstate/machine/maybe.hpp>
#include <groundstate/machine/membership.hpp>
#include <groundstate/machine/numbers.hpp>
#include <groundstate/machine/ranges.hpp>
#include <groundstate/machine/text.hpp>
#include <groundstate/machine/units.hpp>
#include <groundstate/machine/unsequenced.hpp>
#include <groundstate/machine/word.hpp>

namespace arm {

namespace gs = groundstate::machine;

enum class ArmMode : std::uint32_t { STANDING, FOLLOWING, STOPPING };
constexpr std::uint32_t domain_of(ArmMode) { return 89; }

/// What the machine asks for. Each location and clock is asked for at most once per step.
class Environment {
    public:
    virtual ~Environment() = default;

    /// isGuided: Boolean
    virtual gs::Maybe<bool> isGuided() = 0;
    /// isStill: Boolean
    virtual gs::Maybe<bool> isStill() = 0;

    /// A choice among candidates 0 … candidates - 1, by the choose rule at `site`.
    virtual std::size_t choose(std::size_t candidates, gs::Site site) = 0;
    /// A number for a variable that a choose rule binds over all numbers.
    virtual std::int64_t integer(gs::Site, std::size_t) { return 0; }
    virtual double real(gs::Site, std::size_t) { return 0.0; }
    /// The clock.
    virtual std::int64_t time(gs::TimeUnit) { return 0; }
};

/// The machine: its state and its step.
class Machine {
    public:
    /// Who: the owner. Undefined until `start`.
    explicit Machine(Environment& environment) : environment_{environment} {}
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    /// Sets the initial state. Who: the owner, once, before any step. Returns the fault of an initial value, or none.
    [[nodiscard]] gs::Fault start();
    /// Makes a step. After a fault, or an exception of the environment, the state is the one before.
    [[nodiscard]] gs::Fault step();
    /// Whether the last step had any updates.
    [[nodiscard]] bool changed() const noexcept { return changed_; }

    /// arm: ArmMode
    ArmMode arm() const { return arm_.read(); }

    /// Calls visit(name, arguments, value) for each location of the state, with undef where it has no value.
    /// With an undef argument, an initial value is included once it was read, or if the function has an array.
    template <class Visit>
    void each_location([[maybe_unused]] Visit&& visit) const {
        arm_.each([&](const auto& arguments, const auto& value) { visit("arm", arguments, value); });
    }

    private:
    struct Next;

    [[gnu::always_inline]] inline void r_Main(Next& next);
    ArmMode initial_arm();
    gs::Maybe<bool> isGuided(gs::Site site);
    gs::Maybe<bool> isStill(gs::Site site);
    [[gnu::always_inline]] std::size_t choose(std::size_t candidates, gs::Site site) {
        const std::size_t chosen = environment_.choose(candidates, site);
        if (chosen >= candidates) {
            gs::fail(gs::FaultKind::environment, site, site);
        }
        return chosen;
    }
    void roll_back();
    gs::Value choose_one(const gs::Value& set, gs::Site site) {
        return gs::chosen_of(set, site, [&](std::size_t candidates) { return choose(candidates, site); });
    }
    /// A term in the state before the step.
    template <class Term>
    auto before(Term&& term) {
        auto value = term();
        return value;
    }

    gs::Inputs<gs::Maybe<bool>, gs::Nowhere> isGuided_{};
    gs::Inputs<gs::Maybe<bool>, gs::Nowhere> isStill_{};
    gs::Location<gs::Clashes::impossible, ArmMode> arm_{};
    Environment& environment_;
    bool changed_ = false;
    std::uint64_t step_ = 1;

    /// Updates of the running step, for functions that no `seq` updates.
    struct Next {
        decltype(arm_)::Next arm;
    };
};

}  // namespace arm
