// Integer and Natural arithmetic on values: what numbers.hpp computes, of operands that are Integers.
#pragma once

#include "numbers.hpp"
#include "operands.hpp"

namespace groundstate::machine {

namespace detail {

[[nodiscard]] inline std::int64_t integer_of(const Value& value, Site site) {
    if (!value.is(Kind::integer)) refuse(site, value);
    return value.as_integer();
}

/// Applies an operation on plain numbers (numbers.hpp).
template <typename Operation>
[[nodiscard]] Value integers(const Value& a, const Value& b, Site site, Operation operation) {
    if (!a.is(Kind::integer) || !b.is(Kind::integer)) refuse(site, a, b);
    return Value::integer(operation(a.as_integer(), b.as_integer(), site));
}

}  // namespace detail

[[nodiscard]] inline Value int_neg(const Value& a, Site site) {
    return Value::integer(negate(detail::integer_of(a, site), site));
}

[[nodiscard]] inline Value int_abs(const Value& a, Site site) {
    return Value::integer(absolute(detail::integer_of(a, site), site));
}

[[nodiscard]] inline Value int_add(const Value& a, const Value& b, Site site) { return detail::integers(a, b, site, add); }
[[nodiscard]] inline Value int_sub(const Value& a, const Value& b, Site site) { return detail::integers(a, b, site, subtract); }
[[nodiscard]] inline Value int_mul(const Value& a, const Value& b, Site site) { return detail::integers(a, b, site, multiply); }
[[nodiscard]] inline Value int_min(const Value& a, const Value& b, Site site) { return detail::integers(a, b, site, minimum); }
[[nodiscard]] inline Value int_max(const Value& a, const Value& b, Site site) { return detail::integers(a, b, site, maximum); }

/// `idiv`, truncated toward zero, so that a = idiv(a, b) * b + mod(a, b).
[[nodiscard]] inline Value int_quotient(const Value& a, const Value& b, Site site) {
    return detail::integers(a, b, site, quotient);
}

/// `mod`, with the sign of the dividend.
[[nodiscard]] inline Value int_mod(const Value& a, const Value& b, Site site) { return detail::integers(a, b, site, remainder); }

/// `div`: the quotient as a Real.
[[nodiscard]] inline Value int_div(const Value& a, const Value& b, Site site) {
    if (!a.is(Kind::integer) || !b.is(Kind::integer)) detail::refuse(site, a, b);
    return Value::real(divide(a.as_integer(), b.as_integer(), site));
}

/// An exponent outside of 0 to 2^32 - 1 is a bad operand.
[[nodiscard]] inline Value int_power(const Value& a, const Value& b, Site site) { return detail::integers(a, b, site, power); }

[[nodiscard]] inline Value int_to_nat(const Value& a, Site site) {
    return Value::integer(natural(detail::integer_of(a, site), site));
}
[[nodiscard]] inline Value nat_to_int(const Value& a, Site site) { return Value::integer(detail::integer_of(a, site)); }

}  // namespace groundstate::machine
