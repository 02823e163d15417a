// Library functions on sequences and products. Positions count from 0; a position outside is a fault.
#pragma once

#include <algorithm>

#include "operands.hpp"

namespace groundstate::machine {

namespace detail {

/// A position below `bound`.
[[nodiscard]] inline std::size_t position(const Value& index, std::size_t bound, Site site) {
    if (index.as_integer() < 0 || static_cast<std::uint64_t>(index.as_integer()) >= bound) {
        fail(FaultKind::bad_operand, site);
    }
    return static_cast<std::size_t>(index.as_integer());
}

[[nodiscard]] inline const Values& sequence(const Value& value, Site site) {
    if (!value.is(Kind::seq)) refuse(site, value);
    return value.items();
}

/// Only sequences that are not empty have a first and a last element.
[[nodiscard]] inline const Values& not_empty(const Value& value, Site site) {
    const Values& items = sequence(value, site);
    if (items.empty()) fail(FaultKind::bad_operand, site);
    return items;
}

[[nodiscard]] inline Value element_at(Kind kind, const Value& value, const Value& index, Site site) {
    if (!value.is(kind) || !index.is(Kind::integer)) refuse(site, value, index);
    return checked(value.items()[position(index, value.items().size(), site)], site);
}

/// The first position of an element; -1 if it is none.
[[nodiscard]] inline Value index_of(Kind kind, const Value& value, const Value& element, Site site) {
    if (!value.is(kind)) refuse(site, value, element);
    const Values& items = value.items();
    const auto found = std::find(items.begin(), items.end(), element);
    return Value::integer(found == items.end() ? -1 : found - items.begin());
}

/// Some of the elements.
[[nodiscard]] inline Value part(const Values& items, std::size_t from, std::size_t to, Site site) {
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    return checked(Value::seq(Values(at(from), at(to))), site);
}

}  // namespace detail

[[nodiscard]] inline Value seq_length(const Value& seq, Site site) {
    return detail::size_value(detail::sequence(seq, site).size());
}

[[nodiscard]] inline Value seq_is_empty(const Value& seq, Site site) {
    return Value::boolean(detail::sequence(seq, site).empty());
}

[[nodiscard]] inline Value seq_contains(const Value& seq, const Value& element, Site site) {
    return Value::boolean(detail::index_of(Kind::seq, seq, element, site).as_integer() >= 0);
}

[[nodiscard]] inline Value seq_count(const Value& seq, const Value& element, Site site) {
    if (!seq.is(Kind::seq)) detail::refuse(site, seq, element);
    return Value::integer(std::count(seq.items().begin(), seq.items().end(), element));
}

/// `union`: the first, then the second.
[[nodiscard]] inline Value seq_concat(const Value& a, const Value& b, Site site) {
    if (!a.is(Kind::seq) || !b.is(Kind::seq)) detail::refuse(site, a, b);
    Values all;
    all.reserve(a.items().size() + b.items().size());
    all.insert(all.end(), a.items().begin(), a.items().end());
    all.insert(all.end(), b.items().begin(), b.items().end());
    return detail::checked(Value::seq(std::move(all)), site);
}

[[nodiscard]] inline Value append(const Value& seq, const Value& element, Site site) {
    if (!seq.is(Kind::seq)) detail::refuse(site, seq, element);
    Values longer;
    longer.reserve(seq.items().size() + 1);
    longer.insert(longer.end(), seq.items().begin(), seq.items().end());
    longer.push_back(element);
    return detail::checked(Value::seq(std::move(longer)), site);
}

[[nodiscard]] inline Value prepend(const Value& element, const Value& seq, Site site) {
    if (!seq.is(Kind::seq)) detail::refuse(site, element, seq);
    Values longer;
    longer.reserve(seq.items().size() + 1);
    longer.push_back(element);
    longer.insert(longer.end(), seq.items().begin(), seq.items().end());
    return detail::checked(Value::seq(std::move(longer)), site);
}

[[nodiscard]] inline Value first(const Value& seq, Site site) {
    return detail::checked(detail::not_empty(seq, site).front(), site);
}

[[nodiscard]] inline Value last(const Value& seq, Site site) {
    return detail::checked(detail::not_empty(seq, site).back(), site);
}

/// All but the first.
[[nodiscard]] inline Value tail(const Value& seq, Site site) {
    const Values& items = detail::not_empty(seq, site);
    return detail::part(items, 1, items.size(), site);
}

[[nodiscard]] inline Value seq_at(const Value& seq, const Value& index, Site site) {
    return detail::element_at(Kind::seq, seq, index, site);
}

[[nodiscard]] inline Value seq_index_of(const Value& seq, const Value& element, Site site) {
    return detail::index_of(Kind::seq, seq, element, site);
}

/// At a position, or after the last.
[[nodiscard]] inline Value insert_at(const Value& seq, const Value& index, const Value& element, Site site) {
    if (!seq.is(Kind::seq) || !index.is(Kind::integer)) detail::refuse(site, seq, index, element);
    const std::size_t at = detail::position(index, seq.items().size() + 1, site);
    Values longer = seq.items();
    longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), element);
    return detail::checked(Value::seq(std::move(longer)), site);
}

[[nodiscard]] inline Value replace_at(const Value& seq, const Value& index, const Value& element, Site site) {
    if (!seq.is(Kind::seq) || !index.is(Kind::integer)) detail::refuse(site, seq, index, element);
    const std::size_t at = detail::position(index, seq.items().size(), site);
    Values changed = seq.items();
    changed[at] = element;
    return detail::checked(Value::seq(std::move(changed)), site);
}

/// From the first position, included, to the second, excluded.
[[nodiscard]] inline Value sub_sequence(const Value& seq, const Value& from, const Value& to, Site site) {
    if (!seq.is(Kind::seq) || !from.is(Kind::integer) || !to.is(Kind::integer)) detail::refuse(site, seq, from, to);
    const std::size_t behind = detail::position(to, seq.items().size() + 1, site);
    return detail::part(seq.items(), detail::position(from, behind + 1, site), behind, site);
}

/// Without the first occurrence of an element.
[[nodiscard]] inline Value seq_excluding(const Value& seq, const Value& element, Site site) {
    if (!seq.is(Kind::seq)) detail::refuse(site, seq, element);
    Values rest = seq.items();
    if (const auto found = std::find(rest.begin(), rest.end(), element); found != rest.end()) rest.erase(found);
    return detail::checked(Value::seq(std::move(rest)), site);
}

/// `first` … `ninth` of a product, by the component's place from 0.
[[nodiscard]] inline Value component(std::uint32_t index, const Value& tuple, Site site) {
    if (!tuple.is(Kind::tuple)) detail::refuse(site, tuple);
    if (index >= tuple.items().size()) fail(FaultKind::bad_operand, site);
    return detail::checked(tuple.items()[index], site);
}

[[nodiscard]] inline Value tuple_at(const Value& tuple, const Value& index, Site site) {
    return detail::element_at(Kind::tuple, tuple, index, site);
}

[[nodiscard]] inline Value tuple_index_of(const Value& tuple, const Value& element, Site site) {
    return detail::index_of(Kind::tuple, tuple, element, site);
}

/// The component that a pattern of variables binds: not a function of the library, but a term of its own, which calls
/// everything undefined that is no tuple.
[[nodiscard]] inline Value project(const Value& tuple, std::uint32_t index, Site site) {
    if (!tuple.is(Kind::tuple)) fail(FaultKind::undefined_operand, site);
    assert(index < tuple.items().size());
    return tuple.items()[index];
}

}  // namespace groundstate::machine
