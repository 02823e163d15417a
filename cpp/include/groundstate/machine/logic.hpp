// Library functions on any value and on Booleans: equality, definedness, Kleene's connectives.
//
// Equality is total. `and_`, `or_`, `not_`, `implies` are Kleene's: undef is "not known". Here both operands have been
// evaluated; generated code leaves the right one out if the left one decides. Those that are named like a word of C++
// end in `_`.
#pragma once

#include "operands.hpp"

namespace groundstate::machine {

[[nodiscard]] inline Value eq(const Value& a, const Value& b, Site) noexcept { return Value::boolean(a == b); }
[[nodiscard]] inline Value neq(const Value& a, const Value& b, Site) noexcept { return Value::boolean(a != b); }
[[nodiscard]] inline Value is_def(const Value& value, Site) noexcept { return Value::boolean(!value.is_undef()); }
[[nodiscard]] inline Value is_undef(const Value& value, Site) noexcept { return Value::boolean(value.is_undef()); }

namespace detail {

/// One truth value decides, whichever operand has it; otherwise undef prevails.
[[nodiscard]] inline Value connected(const Value& left, const Value& right, bool deciding) noexcept {
    const Value decision = Value::boolean(deciding);
    if (left == decision || right == decision) return decision;
    return left.is_undef() ? left : right;
}

/// Are two truth values the same?
[[nodiscard]] inline bool agree(const Value& a, const Value& b, Site site) {
    if (!a.is(Kind::boolean) || !b.is(Kind::boolean)) refuse(site, a, b);
    return a.as_boolean() == b.as_boolean();
}

}  // namespace detail

[[nodiscard]] inline Value and_(const Value& a, const Value& b, Site) noexcept { return detail::connected(a, b, false); }
[[nodiscard]] inline Value or_(const Value& a, const Value& b, Site) noexcept { return detail::connected(a, b, true); }

[[nodiscard]] inline Value not_(const Value& value, Site) noexcept {
    return value.is(Kind::boolean) ? Value::boolean(!value.as_boolean()) : Value{};
}

[[nodiscard]] inline Value implies(const Value& premise, const Value& conclusion, Site) noexcept {
    const Value yes = Value::boolean(true);
    if (premise == Value::boolean(false) || conclusion == yes) return yes;
    return premise == yes ? conclusion : Value{};
}

[[nodiscard]] inline Value xor_(const Value& a, const Value& b, Site site) {
    return Value::boolean(!detail::agree(a, b, site));
}

[[nodiscard]] inline Value iff(const Value& a, const Value& b, Site site) {
    return Value::boolean(detail::agree(a, b, site));
}

}  // namespace groundstate::machine
