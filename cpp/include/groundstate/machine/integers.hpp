// Integer and Natural arithmetic: 64 bits that never wrap. A result beyond them is a fault.
#pragma once

#include <limits>

#include "operands.hpp"

namespace groundstate::machine {

namespace detail {

[[nodiscard]] inline std::int64_t integer_of(const Value& value, Site site) {
    if (!value.is(Kind::integer)) refuse(site, value);
    return value.as_integer();
}

/// Applies an operation that says whether it overflowed, as the compiler's builtins do.
template <typename Operation>
[[nodiscard]] Value integers(const Value& a, const Value& b, Site site, Operation operation) {
    if (!a.is(Kind::integer) || !b.is(Kind::integer)) refuse(site, a, b);
    std::int64_t result = 0;
    if (operation(a.as_integer(), b.as_integer(), result)) fail(FaultKind::overflow, site);
    return Value::integer(result);
}

/// The same of a division.
template <typename Operation>
[[nodiscard]] Value divided(const Value& a, const Value& b, Site site, Operation operation) {
    return integers(a, b, site, [&](std::int64_t x, std::int64_t y, std::int64_t& result) {
        if (y == 0) fail(FaultKind::division_by_zero, site);
        return operation(x, y, result);
    });
}

/// A Natural, or the fault of a negative number.
[[nodiscard]] inline Value natural(const Value& value, Site site) {
    if (integer_of(value, site) < 0) fail(FaultKind::bad_operand, site);
    return value;
}

}  // namespace detail

[[nodiscard]] inline Value int_neg(const Value& a, Site site) {
    const std::int64_t number = detail::integer_of(a, site);
    if (number == std::numeric_limits<std::int64_t>::min()) fail(FaultKind::overflow, site);
    return Value::integer(-number);
}

[[nodiscard]] inline Value int_abs(const Value& a, Site site) {
    return detail::integer_of(a, site) < 0 ? int_neg(a, site) : a;
}

[[nodiscard]] inline Value int_add(const Value& a, const Value& b, Site site) {
    return detail::integers(a, b, site, [](auto x, auto y, auto& result) { return __builtin_add_overflow(x, y, &result); });
}

[[nodiscard]] inline Value int_sub(const Value& a, const Value& b, Site site) {
    return detail::integers(a, b, site, [](auto x, auto y, auto& result) { return __builtin_sub_overflow(x, y, &result); });
}

[[nodiscard]] inline Value int_mul(const Value& a, const Value& b, Site site) {
    return detail::integers(a, b, site, [](auto x, auto y, auto& result) { return __builtin_mul_overflow(x, y, &result); });
}

[[nodiscard]] inline Value int_min(const Value& a, const Value& b, Site site) {
    return detail::integers(a, b, site, [](auto x, auto y, auto& result) {
        result = std::min(x, y);
        return false;
    });
}

[[nodiscard]] inline Value int_max(const Value& a, const Value& b, Site site) {
    return detail::integers(a, b, site, [](auto x, auto y, auto& result) {
        result = std::max(x, y);
        return false;
    });
}

/// `idiv`, truncated toward zero, so that a = idiv(a, b) * b + mod(a, b).
[[nodiscard]] inline Value int_quotient(const Value& a, const Value& b, Site site) {
    return detail::divided(a, b, site, [](auto x, auto y, auto& result) {
        if (y == -1) return __builtin_sub_overflow(std::int64_t{0}, x, &result);
        result = x / y;
        return false;
    });
}

/// `mod`, with the sign of the dividend.
[[nodiscard]] inline Value int_mod(const Value& a, const Value& b, Site site) {
    return detail::divided(a, b, site, [](auto x, auto y, auto& result) {
        // The least integer by -1 would trap, although its remainder is 0.
        result = y == -1 ? 0 : x % y;
        return false;
    });
}

/// `div`: the quotient as a Real.
[[nodiscard]] inline Value int_div(const Value& a, const Value& b, Site site) {
    if (!a.is(Kind::integer) || !b.is(Kind::integer)) detail::refuse(site, a, b);
    if (b.as_integer() == 0) fail(FaultKind::division_by_zero, site);
    return Value::real(static_cast<double>(a.as_integer()) / static_cast<double>(b.as_integer()));
}

/// An exponent outside of 0 to 2^32 - 1 is a bad operand.
[[nodiscard]] inline Value int_power(const Value& a, const Value& b, Site site) {
    return detail::integers(a, b, site, [site](std::int64_t base, std::int64_t exponent, std::int64_t& result) {
        if (exponent < 0 || exponent > std::numeric_limits<std::uint32_t>::max()) fail(FaultKind::bad_operand, site);
        result = 1;
        for (; exponent > 0; exponent /= 2) {
            if (exponent % 2 == 1 && __builtin_mul_overflow(result, base, &result)) return true;
            if (exponent > 1 && __builtin_mul_overflow(base, base, &base)) return true;
        }
        return false;
    });
}

[[nodiscard]] inline Value int_to_nat(const Value& a, Site site) { return detail::natural(a, site); }
[[nodiscard]] inline Value nat_to_int(const Value& a, Site site) { return Value::integer(detail::integer_of(a, site)); }

}  // namespace groundstate::machine
