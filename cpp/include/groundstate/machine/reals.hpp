// Real arithmetic, the order of numbers and characters, and conversions between Integer and Real.
//
// Integers stand for Reals wherever Reals are expected. A result that is not a number is a fault; infinity is a Real.
// The host's `double` must be IEEE 754's, and its rules must be kept: no -ffast-math.
#pragma once

#include <cmath>
#include <compare>
#include <optional>

#include "integers.hpp"
#include "operands.hpp"

namespace groundstate::machine {

namespace detail {

[[nodiscard]] inline std::optional<double> as_number(const Value& value) noexcept {
    if (value.is(Kind::real)) return value.as_real();
    if (value.is(Kind::integer)) return static_cast<double>(value.as_integer());
    return {};
}

[[nodiscard]] inline double number_of(const Value& value, Site site) {
    const std::optional<double> number = as_number(value);
    if (!number) refuse(site, value);
    return *number;
}

/// Applies an operation on plain numbers (numbers.hpp).
template <typename Operation>
[[nodiscard]] Value reals(const Value& a, const Value& b, Site site, Operation operation) {
    const std::optional<double> x = as_number(a), y = as_number(b);
    if (!x || !y) refuse(site, a, b);
    return Value::real(operation(*x, *y, site));
}

/// A product rounded by itself: compilers might fuse it with a sum, but the machine rounds twice.
[[nodiscard]] inline double product(double a, double b) noexcept {
    const volatile double rounded = a * b;
    return rounded;
}

/// Integers by their exact values, Reals by theirs, mixed ones as Reals; characters by number.
[[nodiscard]] inline std::strong_ordering ordered(const Value& a, const Value& b, Site site) {
    if (a.kind() == b.kind() && (a.is(Kind::integer) || a.is(Kind::character))) return a <=> b;
    const std::optional<double> x = as_number(a), y = as_number(b);
    if (!x || !y) refuse(site, a, b);
    return order(*x, *y);
}

}  // namespace detail

[[nodiscard]] inline Value lt(const Value& a, const Value& b, Site site) {
    return Value::boolean(detail::ordered(a, b, site) < 0);
}

[[nodiscard]] inline Value le(const Value& a, const Value& b, Site site) {
    return Value::boolean(detail::ordered(a, b, site) <= 0);
}

[[nodiscard]] inline Value gt(const Value& a, const Value& b, Site site) {
    return Value::boolean(detail::ordered(a, b, site) > 0);
}

[[nodiscard]] inline Value ge(const Value& a, const Value& b, Site site) {
    return Value::boolean(detail::ordered(a, b, site) >= 0);
}

[[nodiscard]] inline Value real_neg(const Value& a, Site site) {
    return Value::real(real_negate(detail::number_of(a, site), site));
}
[[nodiscard]] inline Value real_abs(const Value& a, Site site) {
    return Value::real(real_absolute(detail::number_of(a, site), site));
}
[[nodiscard]] inline Value real_add(const Value& a, const Value& b, Site site) {
    return detail::reals(a, b, site, [](double x, double y, Site at) { return real_add(x, y, at); });
}
[[nodiscard]] inline Value real_sub(const Value& a, const Value& b, Site site) { return detail::reals(a, b, site, real_subtract); }
[[nodiscard]] inline Value real_mul(const Value& a, const Value& b, Site site) { return detail::reals(a, b, site, real_multiply); }

[[nodiscard]] inline Value real_div(const Value& a, const Value& b, Site site) {
    // A zero counts before the dividend's universe does.
    if (detail::as_number(b) == 0.0 && !a.is_undef()) fail(FaultKind::division_by_zero, site);
    return detail::reals(a, b, site, real_divide);
}

[[nodiscard]] inline Value real_min(const Value& a, const Value& b, Site site) { return detail::reals(a, b, site, real_minimum); }
[[nodiscard]] inline Value real_max(const Value& a, const Value& b, Site site) { return detail::reals(a, b, site, real_maximum); }
[[nodiscard]] inline Value real_power(const Value& a, const Value& b, Site site) {
    return detail::reals(a, b, site, [](double x, double y, Site at) { return real_power(x, y, at); });
}

/// Of a negative number it is not a number.
[[nodiscard]] inline Value sqrt(const Value& a, Site site) {
    return Value::real(square_root(detail::number_of(a, site), site));
}
[[nodiscard]] inline Value floor(const Value& a, Site site) { return Value::integer(floor(detail::number_of(a, site), site)); }
/// Halves go up.
[[nodiscard]] inline Value round(const Value& a, Site site) { return Value::integer(round(detail::number_of(a, site), site)); }
[[nodiscard]] inline Value real_to_int(const Value& a, Site site) {
    return Value::integer(truncate(detail::number_of(a, site), site));
}
[[nodiscard]] inline Value real_to_nat(const Value& a, Site site) {
    return Value::integer(truncate_natural(detail::number_of(a, site), site));
}
[[nodiscard]] inline Value int_to_real(const Value& a, Site site) { return Value::real(detail::number_of(a, site)); }
[[nodiscard]] inline Value nat_to_real(const Value& a, Site site) { return Value::real(detail::number_of(a, site)); }

/// An Integer where the model expects a Real; anything else is unchanged.
[[nodiscard]] inline Value coerce_real(const Value& value) noexcept {
    return value.is(Kind::integer) ? Value::real(static_cast<double>(value.as_integer())) : value;
}

}  // namespace groundstate::machine
