// The machine Servoing in C++, made by groundstate from Servoing.asm. Overwritten by each generation.
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

namespace servoing {

namespace gs = groundstate::machine;

enum class ServoMode : std::uint32_t { WITHOUT_TARGET, SEARCHING, TRACKING, CONVERGED, COVERED, LOST };
constexpr std::uint32_t domain_of(ServoMode) { return 88; }

/// What the machine asks for. Each location and clock is asked for at most once per step.
class Environment {
    public:
    virtual ~Environment() = default;

    /// hasTarget: Boolean
    virtual gs::Maybe<bool> hasTarget() = 0;
    /// isSeen: Boolean
    virtual gs::Maybe<bool> isSeen() = 0;
    /// hasLaw: Boolean
    virtual gs::Maybe<bool> hasLaw() = 0;
    /// isClose: Boolean
    virtual gs::Maybe<bool> isClose() = 0;

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

    /// panel: ServoMode
    ServoMode panel() const { return panel_.read(); }
    /// guiding: Boolean
    gs::Maybe<bool> guiding() const { return guiding_.read(); }
    /// unseen: Images
    std::int64_t unseen() const { return unseen_.read(); }

    /// Calls visit(name, arguments, value) for each location of the state, with undef where it has no value.
    /// With an undef argument, an initial value is included once it was read, or if the function has an array.
    template <class Visit>
    void each_location([[maybe_unused]] Visit&& visit) const {
        panel_.each([&](const auto& arguments, const auto& value) { visit("panel", arguments, value); });
        guiding_.each([&](const auto& arguments, const auto& value) { visit("guiding", arguments, value); });
        unseen_.each([&](const auto& arguments, const auto& value) { visit("unseen", arguments, value); });
    }

    private:
    struct Next;

    [[gnu::always_inline]] inline void r_Main(Next& next);
    [[gnu::always_inline]] inline void r_is(Next& next, ServoMode mode, bool guiding_2, std::int64_t unseen_2);
    [[gnu::always_inline]] inline void r_is_2(Next& next, std::int64_t unseen_2);
    [[gnu::always_inline]] inline void r_is_3(Next& next, ServoMode mode);
    [[gnu::always_inline]] inline void r_is_4(Next& next, bool guiding_2, std::int64_t unseen_2);
    inline std::int64_t patience();
    inline bool isFollowing();
    ServoMode initial_panel();
    gs::Maybe<bool> initial_guiding();
    std::int64_t initial_unseen();
    gs::Maybe<bool> hasTarget(gs::Site site);
    gs::Maybe<bool> isSeen(gs::Site site);
    gs::Maybe<bool> hasLaw(gs::Site site);
    gs::Maybe<bool> isClose(gs::Site site);
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

    gs::Inputs<gs::Maybe<bool>, gs::Nowhere> hasTarget_{};
    gs::Inputs<gs::Maybe<bool>, gs::Nowhere> isSeen_{};
    gs::Inputs<gs::Maybe<bool>, gs::Nowhere> hasLaw_{};
    gs::Inputs<gs::Maybe<bool>, gs::Nowhere> isClose_{};
    gs::Location<gs::Clashes::impossible, ServoMode> panel_{};
    gs::Location<gs::Clashes::impossible, gs::Maybe<bool>> guiding_{};
    gs::Location<gs::Clashes::impossible, std::int64_t> unseen_{};
    Environment& environment_;
    bool changed_ = false;
    std::uint64_t step_ = 1;

    /// Updates of the running step, for functions that no `seq` updates.
    struct Next {
        decltype(panel_)::Next panel;
        decltype(guiding_)::Next guiding;
        decltype(unseen_)::Next unseen;
    };
};

}  // namespace servoing
