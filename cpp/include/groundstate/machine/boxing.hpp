// From typed scalars to dynamic values and back, and what generated terms need besides.
//
// The generated code says by `domain_of` which domain of the model an enum type or element type stands for.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "library.hpp"
#include "lists.hpp"
#include "maybe.hpp"
#include "ranges.hpp"

namespace groundstate::machine {

template <class T>
Value box(T value) {
    if constexpr (std::is_same_v<T, Value>) {
        return value;
    } else if constexpr (std::is_same_v<T, bool>) {
        return Value::boolean(value);
    } else if constexpr (std::is_same_v<T, char32_t>) {
        return Value::character(value);
    } else if constexpr (std::is_floating_point_v<T>) {
        return Value::real(value);
    } else if constexpr (std::is_integral_v<T>) {
        return Value::integer(value);
    } else if constexpr (std::is_enum_v<T>) {
        return Value::enumeration(domain_of(value), ordinal(value));
    } else {
        return Value::element(domain_of(value), ordinal(value));
    }
}

template <class T>
Value box(const Maybe<T>& value);
template <class T>
Value box(const List<T>& list) {
    Values items;
    items.reserve(list.size());
    for (std::size_t place = 0; place < list.size(); ++place) {
        items.push_back(box(list[place]));
    }
    return Value::seq(std::move(items));
}
template <class T>
Value box(const Maybe<T>& value) {
    return value.defined ? box(value.value) : Value{};
}

/// What a typed sequence is a sequence of.
template <class T>
struct ListOf {
    static constexpr bool is = false;
};
template <class T>
struct ListOf<List<T>> {
    static constexpr bool is = true;
    using Item = T;
};

/// The scalar or list of scalars that a value holds; undef if it is undef, a fault if it is of another kind.
template <class T>
Maybe<T> unbox(const Value& value, Site site) {
    if (value.is_undef()) {
        return {};
    }
    if constexpr (ListOf<T>::is) {
        if (value.is(Kind::seq)) {
            T list;
            for (const Value& item : value.items()) {
                list.push_back(unbox<typename ListOf<T>::Item>(item, site), site);
            }
            return list;
        }
    } else if constexpr (std::is_same_v<T, bool>) {
        if (value.is(Kind::boolean)) return value.as_boolean();
    } else if constexpr (std::is_same_v<T, char32_t>) {
        if (value.is(Kind::character)) return value.as_character();
    } else if constexpr (std::is_floating_point_v<T>) {
        if (value.is(Kind::real)) return value.as_real();
        if (value.is(Kind::integer)) return static_cast<double>(value.as_integer());
    } else if constexpr (std::is_integral_v<T>) {
        if (value.is(Kind::integer)) return value.as_integer();
    } else if constexpr (std::is_enum_v<T>) {
        if (value.is(Kind::enumeration) && value.domain() == domain_of(T{})) return from_ordinal<T>(value.index());
    } else {
        if (value.is(Kind::element) && value.domain() == domain_of(T{})) return from_ordinal<T>(value.index());
    }
    fail(FaultKind::bad_operand, site, site);
}

inline bool is_defined(const Value& value) noexcept { return !value.is_undef(); }

/// The procedure that a value is.
inline std::uint32_t rule_of(const Value& value, Site site) {
    if (!value.is(Kind::rule)) [[unlikely]] {
        fail(FaultKind::not_a_rule, site, site);
    }
    return value.as_rule();
}

/// The values of a range, as dynamic values.
template <class Range>
Values boxed(const Range& range) {
    Values all;
    for (const auto& item : range) {
        all.push_back(box(item));
    }
    return all;
}

/// Adds an element to a collection that is being built.
inline void append_to(Values& items, Value item, Site site) {
    items.push_back(std::move(item));
    check_size(items.size(), site);
}

/// `{low : high, step}` by dynamic values.
inline Value range_by(const Value& low, const Value& high, const Value& step, CollectionKind kind, Site site) {
    return range(low, high, &step, kind, site);
}

/// `chooseone(set)`: an element that `choose(candidates)` picks; undef of an empty set.
template <class Choose>
Value chosen_of(const Value& set, Site site, Choose&& choose) {
    if (!set.is(Kind::set)) [[unlikely]] {
        fail(FaultKind::undefined_operand, site, site);
    }
    return set.items().empty() ? Value{} : set.items()[choose(set.items().size())];
}

}  // namespace groundstate::machine
