// A scalar that may be undef, and its use as a guard and as an operand.
//
// Only terms that may be undef have this type; a term that the generator knows to be defined is a plain T. Equality is
// total, and undef equals undef; in every other use, undef is a fault (spec/language.md).
#pragma once

#include <compare>
#include <cstdint>
#include <type_traits>

#include "fault.hpp"
#include "numbers.hpp"

// A lambda that is called at once is part of the code around it.
#define GROUNDSTATE_CALLED __attribute__((always_inline))

namespace groundstate::machine {

/// The value undef, of any domain.
struct Undef {};
inline constexpr Undef undef{};

/// A value of T, or undef. `value` is T{} if it is undef, so equality and order may compare it without a test.
template <class T>
struct Maybe {
    T value{};
    bool defined = false;

    constexpr Maybe() = default;
    constexpr Maybe(T given) : value{given}, defined{true} {}  // NOLINT: every T is one
    constexpr Maybe(Undef) {}                                   // NOLINT: so is undef

    friend constexpr bool operator==(const Maybe&, const Maybe&) = default;
};

/// The value itself: for comparing a term with itself, of which compilers would warn.
template <class T>
constexpr const T& itself(const T& value) noexcept {
    return value;
}

template <class T>
constexpr bool is_defined(const Maybe<T>& value) noexcept {
    return value.defined;
}

/// What a machine does with a value: an operand.
template <class T>
constexpr T need(const Maybe<T>& value, Site site) {
    if (!value.defined) [[unlikely]] {
        fail(FaultKind::undefined_operand, site, site);
    }
    return value.value;
}

/// A term that is always a fault.
template <class T>
[[noreturn]] T failed(FaultKind kind, Site site) {
    fail(kind, site, site);
}

/// The truth of a guard.
constexpr bool holds(const Maybe<bool>& value, Site site) {
    if (!value.defined) [[unlikely]] {
        fail(FaultKind::undefined_guard, site, site);
    }
    return value.value;
}
constexpr bool holds(bool value, Site) noexcept { return value; }

// Kleene's connectives; the right operand is evaluated only if it matters.

template <class Right>
constexpr Maybe<bool> conjunction(Maybe<bool> left, Right right) {
    if (left.defined && !left.value) {
        return left;
    }
    const Maybe<bool> other = right();
    return (other.defined && !other.value) || left.defined ? other : left;
}

template <class Right>
constexpr Maybe<bool> disjunction(Maybe<bool> left, Right right) {
    if (left.defined && left.value) {
        return left;
    }
    const Maybe<bool> other = right();
    return (other.defined && other.value) || left.defined ? other : left;
}

template <class Right>
constexpr Maybe<bool> implication(Maybe<bool> left, Right right) {
    if (left.defined && !left.value) {
        return true;
    }
    const Maybe<bool> other = right();
    if (other.defined && other.value) {
        return true;
    }
    return left.defined ? other : Maybe<bool>{};
}

constexpr Maybe<bool> negation(Maybe<bool> operand) {
    return operand.defined ? Maybe<bool>{!operand.value} : operand;
}

constexpr Maybe<double> to_real(const Maybe<std::int64_t>& a) {
    return a.defined ? Maybe<double>{to_real(a.value)} : Maybe<double>{};
}

}  // namespace groundstate::machine
