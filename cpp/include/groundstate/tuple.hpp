// Tuples of data: what a channel or device carries whose domain is a product. The parts are called as AsmetaL calls them.
//
// They are plain memory if their parts are, so that channels copy them. A tuple may be a part of another one.
#pragma once

#include <type_traits>

namespace groundstate {

/// A tuple of two to five parts.
template <class... Parts>
struct Tuple;

template <class A, class B>
struct Tuple<A, B> {
    A first{};
    B second{};
    friend constexpr bool operator==(const Tuple&, const Tuple&) = default;
    /// Calls visit(part) for each part in turn.
    template <class Visit>
    constexpr void each(Visit&& visit) const {
        visit(first), visit(second);
    }
    template <class Visit>
    constexpr void each(Visit&& visit) {
        visit(first), visit(second);
    }
};

template <class A, class B, class C>
struct Tuple<A, B, C> {
    A first{};
    B second{};
    C third{};
    friend constexpr bool operator==(const Tuple&, const Tuple&) = default;
    template <class Visit>
    constexpr void each(Visit&& visit) const {
        visit(first), visit(second), visit(third);
    }
    template <class Visit>
    constexpr void each(Visit&& visit) {
        visit(first), visit(second), visit(third);
    }
};

template <class A, class B, class C, class D>
struct Tuple<A, B, C, D> {
    A first{};
    B second{};
    C third{};
    D fourth{};
    friend constexpr bool operator==(const Tuple&, const Tuple&) = default;
    template <class Visit>
    constexpr void each(Visit&& visit) const {
        visit(first), visit(second), visit(third), visit(fourth);
    }
    template <class Visit>
    constexpr void each(Visit&& visit) {
        visit(first), visit(second), visit(third), visit(fourth);
    }
};

template <class A, class B, class C, class D, class E>
struct Tuple<A, B, C, D, E> {
    A first{};
    B second{};
    C third{};
    D fourth{};
    E fifth{};
    friend constexpr bool operator==(const Tuple&, const Tuple&) = default;
    template <class Visit>
    constexpr void each(Visit&& visit) const {
        visit(first), visit(second), visit(third), visit(fourth), visit(fifth);
    }
    template <class Visit>
    constexpr void each(Visit&& visit) {
        visit(first), visit(second), visit(third), visit(fourth), visit(fifth);
    }
};

/// Whether a type is a tuple.
template <class T>
inline constexpr bool is_tuple = false;
template <class... Parts>
inline constexpr bool is_tuple<Tuple<Parts...>> = true;

/// Calls visit(part) for each part that is no tuple, in turn: of a value that is no tuple, for itself.
template <class T, class Visit>
constexpr void each_scalar(T&& value, Visit&& visit) {
    if constexpr (is_tuple<std::remove_cvref_t<T>>) {
        value.each([&](auto& part) { each_scalar(part, visit); });
    } else {
        visit(value);
    }
}

}  // namespace groundstate
