// Units and sequences over several functions: what `seq`, the loops and turbo calls do to the update set.
//
// A rule of the generated code names the functions that it may update; it touches no other. A fault in the middle needs
// no ending: the step rolls all functions back.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "locations.hpp"

namespace groundstate::machine {

/// A rule whose updates must agree among themselves, before they join those of the enclosing one.
template <class... Parts>
class Unit {
  public:
    explicit Unit(Parts&... parts) : parts_{parts...}, marks_{parts.open()...} {}

    /// Ends it.
    void join() {
        each([](auto& part, Mark mark) { part.join(mark); });
    }

    bool empty() const {
        return std::apply([](const auto&... part) { return (part.empty() && ...); }, parts_);
    }

  protected:
    template <class Do>
    void each(Do&& action) {
        each(action, std::index_sequence_for<Parts...>{});
    }

  private:
    template <class Do, std::size_t... Places>
    void each(Do& action, std::index_sequence<Places...>) {
        (action(std::get<Places>(parts_), marks_[Places]), ...);
    }

    std::tuple<Parts&...> parts_;
    std::array<Mark, sizeof...(Parts)> marks_;
};

template <>
class Unit<> {
  public:
    void join() {}
    bool empty() const { return true; }
};

/// Parts one after the other, each in the state that the one before made.
template <class... Parts>
class Sequence : private Unit<Parts...> {
  public:
    explicit Sequence(Parts&... parts) : Unit<Parts...>{parts...} {}

    /// Ends a part; tells whether it had any update.
    bool part() {
        const bool any = !this->empty();
        if (any) {
            this->each([](auto& part, Mark mark) { part.apply(mark); });
        }
        return any;
    }

    /// Ends it: its net effect joins the enclosing unit.
    void end() {
        this->each([](auto& part, Mark mark) { part.end(mark); });
    }
};

template <>
class Sequence<> {
  public:
    bool part() { return false; }
    void end() {}
};

/// The scope of local functions: undefined at first, and without a trace.
template <class... Locals>
class Scope {
  public:
    explicit Scope(Locals&... locals) : locals_{locals...}, marks_{locals.open()...}, hidden_{locals.hide()...} {}

    /// Ends a part of the rule: its updates of the locals make the intermediate state.
    bool part() {
        const bool any = !std::apply([](const auto&... local) { return (local.empty() && ...); }, locals_);
        apply(std::index_sequence_for<Locals...>{});
        return any;
    }

    void end() { end(std::index_sequence_for<Locals...>{}); }

  private:
    template <std::size_t... Places>
    void apply(std::index_sequence<Places...>) {
        (std::get<Places>(locals_).apply(marks_[Places]), ...);
    }
    template <std::size_t... Places>
    void end(std::index_sequence<Places...>) {
        (std::get<Places>(locals_).drop(marks_[Places]), ...);
        (std::get<Places>(locals_).restore(std::get<Places>(hidden_)), ...);
    }

    std::tuple<Locals&...> locals_;
    std::array<Mark, sizeof...(Locals)> marks_;
    std::tuple<decltype(std::declval<Locals&>().hide())...> hidden_;
};

}  // namespace groundstate::machine
