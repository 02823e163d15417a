// Library functions on sets, and `range` on Naturals.
#pragma once

#include <algorithm>
#include <iterator>

#include "operands.hpp"

namespace groundstate::machine {

namespace detail {

[[nodiscard]] inline const Values& elements_of(const Value& value, Site site) {
    if (!value.is(Kind::set)) refuse(site, value);
    return value.items();
}

[[nodiscard]] inline bool has(const Value& set, const Value& element, Site site) {
    if (!set.is(Kind::set)) refuse(site, set, element);
    return std::binary_search(set.items().begin(), set.items().end(), element);
}

[[nodiscard]] inline bool is_subset(const Value& a, const Value& b, Site site) {
    if (!a.is(Kind::set) || !b.is(Kind::set)) refuse(site, a, b);
    return std::includes(b.items().begin(), b.items().end(), a.items().begin(), a.items().end());
}

/// Combines two sets by one of the algorithms on sorted ranges.
template <typename Algorithm>
[[nodiscard]] Value combined(const Value& a, const Value& b, Site site, Algorithm algorithm) {
    if (!a.is(Kind::set) || !b.is(Kind::set)) refuse(site, a, b);
    Values result;
    algorithm(a.items().begin(), a.items().end(), b.items().begin(), b.items().end(), std::back_inserter(result));
    return checked(Value::sorted_set(std::move(result)), site);
}

}  // namespace detail

[[nodiscard]] inline Value set_size(const Value& set, Site site) {
    return detail::size_value(detail::elements_of(set, site).size());
}

[[nodiscard]] inline Value set_is_empty(const Value& set, Site site) {
    return Value::boolean(detail::elements_of(set, site).empty());
}

[[nodiscard]] inline Value set_not_empty(const Value& set, Site site) {
    return Value::boolean(!detail::elements_of(set, site).empty());
}

[[nodiscard]] inline Value set_contains(const Value& set, const Value& element, Site site) {
    return Value::boolean(detail::has(set, element, site));
}

[[nodiscard]] inline Value set_not_in(const Value& set, const Value& element, Site site) {
    return Value::boolean(!detail::has(set, element, site));
}

/// The first is a subset of the second.
[[nodiscard]] inline Value all_in(const Value& a, const Value& b, Site site) {
    return Value::boolean(detail::is_subset(a, b, site));
}

[[nodiscard]] inline Value not_all_in(const Value& a, const Value& b, Site site) {
    return Value::boolean(!detail::is_subset(a, b, site));
}

[[nodiscard]] inline Value set_union(const Value& a, const Value& b, Site site) {
    return detail::combined(a, b, site, [](auto... ranges) { std::set_union(ranges...); });
}

[[nodiscard]] inline Value set_intersection(const Value& a, const Value& b, Site site) {
    return detail::combined(a, b, site, [](auto... ranges) { std::set_intersection(ranges...); });
}

[[nodiscard]] inline Value set_difference(const Value& a, const Value& b, Site site) {
    return detail::combined(a, b, site, [](auto... ranges) { std::set_difference(ranges...); });
}

[[nodiscard]] inline Value symmetric_difference(const Value& a, const Value& b, Site site) {
    return detail::combined(a, b, site, [](auto... ranges) { std::set_symmetric_difference(ranges...); });
}

[[nodiscard]] inline Value set_including(const Value& set, const Value& element, Site site) {
    if (detail::has(set, element, site)) return detail::checked(set, site);
    Values more = set.items();
    more.insert(std::lower_bound(more.begin(), more.end(), element), element);
    return detail::checked(Value::sorted_set(std::move(more)), site);
}

[[nodiscard]] inline Value set_excluding(const Value& set, const Value& element, Site site) {
    if (!detail::has(set, element, site)) return detail::checked(set, site);
    Values fewer = set.items();
    fewer.erase(std::lower_bound(fewer.begin(), fewer.end(), element));
    return detail::checked(Value::sorted_set(std::move(fewer)), site);
}

/// `range`: the numbers from the first to the second, both included.
[[nodiscard]] inline Value natural_range(const Value& low, const Value& high, Site site) {
    if (!low.is(Kind::integer) || !high.is(Kind::integer)) detail::refuse(site, low, high);
    Values numbers;
    if (low.as_integer() <= high.as_integer()) {
        const auto distance = static_cast<std::uint64_t>(high.as_integer()) - static_cast<std::uint64_t>(low.as_integer());
        if (distance > 100'000'000) fail(FaultKind::bad_operand, site);
        check_size(distance + 1, site);
        numbers.reserve(distance + 1);
        for (std::int64_t i = 0; i <= static_cast<std::int64_t>(distance); ++i) {
            numbers.push_back(Value::integer(low.as_integer() + i));
        }
    }
    return Value::sorted_set(std::move(numbers));
}

}  // namespace groundstate::machine
