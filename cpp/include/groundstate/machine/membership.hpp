// Whether a value may be written to a function: this is checked for each update, and for each value from the
// environment.
//
// Each check returns the value, so it can be written around it; undef is in every domain. What is checked beyond the
// type is that of crates/machine/src/membership.rs.
#pragma once

#include <cstdint>

#include "keys.hpp"
#include "maybe.hpp"

namespace groundstate::machine {

namespace detail {

template <class T>
struct Plain {
    using Type = T;
    static constexpr bool defined(const T&) { return true; }
    static constexpr const T& value(const T& value) { return value; }
};
template <class T>
struct Plain<Maybe<T>> {
    using Type = T;
    static constexpr bool defined(const Maybe<T>& value) { return value.defined; }
    static constexpr const T& value(const Maybe<T>& value) { return value.value; }
};
#if !defined(GROUNDSTATE_BARE)
template <>
struct Plain<Value> {
    using Type = Value;
    static bool defined(const Value& value) { return !value.is_undef(); }
    static const Value& value(const Value& value) { return value; }
};
#endif

/// `value`, if it is undef or `fits` says so.
template <class T, class Fits>
constexpr T member(T value, Site site, Fits&& fits) {
    if (Plain<T>::defined(value) && !fits(Plain<T>::value(value))) [[unlikely]] {
        fail(FaultKind::out_of_domain, site, site);
    }
    return value;
}

}  // namespace detail

/// A Natural.
template <class T>
constexpr T not_negative(T value, Site site) {
    return detail::member(std::move(value), site, [](std::int64_t number) { return number >= 0; });
}

/// An integer from low to high.
template <class T>
constexpr T between(T value, std::int64_t low, std::int64_t high, Site site) {
    return detail::member(std::move(value), site, [=](std::int64_t number) { return low <= number && number <= high; });
}

/// Whether a value is in a table.
template <class T, class Table>
constexpr bool among(const T& value, const Table& table) {
    for (const auto& item : table) {
        if (item == value) {
            return true;
        }
    }
    return false;
}

/// A value that is in a table.
template <class T, class Table>
constexpr T within(T value, const Table& table, Site site) {
    return detail::member(std::move(value), site, [&](const auto& item) { return among(item, table); });
}

/// An element of a growing subset.
template <class T, class Subset>
constexpr T within_subset(T value, const Subset& subset, Site site) {
    return detail::member(std::move(value), site, [&](const auto& item) { return subset.contains(ordinal(item)); });
}

/// A value of a domain that nothing is known to be in.
template <class T>
constexpr T nothing_but_undef(T value, Site site) {
    return detail::member(std::move(value), site, [](const auto&) { return false; });
}

}  // namespace groundstate::machine
