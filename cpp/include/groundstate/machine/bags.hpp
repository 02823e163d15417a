// Library functions on bags, on a set and a bag, and the conversions and sums of all three kinds of collections.
//
// A set may stand for a bag, with each of its elements once.
#pragma once

#include <algorithm>
#include <limits>

#include "complex_numbers.hpp"
#include "operands.hpp"

namespace groundstate::machine {

namespace detail {

/// A collection as a bag.
[[nodiscard]] inline bool is_countable(const Value& value) noexcept { return value.is(Kind::bag) || value.is(Kind::set); }

[[nodiscard]] inline Counts counts_of(const Value& value) {
    if (value.is(Kind::bag)) return value.as_bag();
    Counts counts;
    counts.reserve(value.items().size());
    for (const Value& element : value.items()) counts.emplace_back(element, 1);
    return counts;
}

[[nodiscard]] inline std::uint64_t count_of(const Value& bag, const Value& element, Site site) {
    if (!is_countable(bag)) refuse(site, bag, element);
    if (bag.is(Kind::set)) return std::binary_search(bag.items().begin(), bag.items().end(), element) ? 1 : 0;
    const Counts& counts = bag.as_bag();
    const auto found = std::lower_bound(counts.begin(), counts.end(), element,
                                        [](const auto& item, const Value& sought) { return item.first < sought; });
    return found != counts.end() && found->first == element ? found->second : 0;
}

[[nodiscard]] inline Value saturated(std::uint64_t count) noexcept {
    constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
    return Value::integer(static_cast<std::int64_t>(std::min(count, most)));
}

/// How often each element of either occurs in the combination of both, from its counts in each.
template <typename Both>
[[nodiscard]] Counts combined_counts(const Value& left, const Value& right, Site site, Both both) {
    if (!is_countable(left) || !is_countable(right)) refuse(site, left, right);
    const Counts a = counts_of(left), b = counts_of(right);
    Counts combined;
    auto x = a.begin();
    auto y = b.begin();
    while (x != a.end() || y != b.end()) {
        const bool from_left = x != a.end() && (y == b.end() || x->first <= y->first);
        const bool from_right = y != b.end() && (x == a.end() || y->first <= x->first);
        const std::uint64_t count = both(from_left ? x->second : 0, from_right ? y->second : 0);
        if (count > 0) combined.emplace_back(from_left ? x->first : y->first, count);
        if (from_left) ++x;
        if (from_right) ++y;
    }
    return combined;
}

[[nodiscard]] inline Counts added(const Value& a, const Value& b, Site site) {
    return combined_counts(a, b, site, saturating_sum);
}

[[nodiscard]] inline Counts shared(const Value& a, const Value& b, Site site) {
    return combined_counts(a, b, site, [](std::uint64_t x, std::uint64_t y) { return std::min(x, y); });
}

/// The bag with an element that many times.
[[nodiscard]] inline Value with_count(const Value& bag, const Value& element, std::uint64_t count, Site site) {
    Counts counts = counts_of(bag);
    const auto found = std::lower_bound(counts.begin(), counts.end(), element,
                                        [](const auto& item, const Value& sought) { return item.first < sought; });
    if (found == counts.end() || found->first != element) {
        if (count > 0) counts.emplace(found, element, count);
    } else if (count > 0) {
        found->second = count;
    } else {
        counts.erase(found);
    }
    return checked(Value::sorted_bag(std::move(counts)), site);
}

/// The elements of a set, sequence or bag, in their order.
[[nodiscard]] inline Values members(const Value& value, Site site) {
    if (value.is(Kind::set) || value.is(Kind::seq)) return value.items();
    if (!value.is(Kind::bag)) refuse(site, value);
    const std::uint64_t size = total(value.as_bag());
    check_size(size, site);
    Values all;
    all.reserve(size);
    for (const auto& [element, count] : value.as_bag()) all.insert(all.end(), count, element);
    return all;
}

/// The sum of numbers of one kind; `zero` of none.
[[nodiscard]] inline Value sum(const Value& collection, const Value& zero, Site site) {
    const Values items = members(collection, site);
    if (items.empty()) return zero;
    Value total = items.front();
    for (std::size_t i = 1; i < items.size(); ++i) {
        // Here a summand is not an operand: an element that is not a number makes the collection a bad one.
        if (!as_parts(total) || !as_parts(items[i])) refuse(site, collection);
        if (total.is(Kind::integer) && items[i].is(Kind::integer)) {
            total = int_add(total, items[i], site);
        } else if (total.is(Kind::complex) || items[i].is(Kind::complex)) {
            total = complex_add(total, items[i], site);
        } else {
            total = real_add(total, items[i], site);
        }
    }
    if (!as_parts(total)) refuse(site, collection);
    return total;
}

}  // namespace detail

[[nodiscard]] inline Value bag_union(const Value& a, const Value& b, Site site) {
    return detail::checked(Value::sorted_bag(detail::added(a, b, site)), site);
}

[[nodiscard]] inline Value set_bag_union(const Value& a, const Value& b, Site site) { return bag_union(a, b, site); }
[[nodiscard]] inline Value bag_set_union(const Value& a, const Value& b, Site site) { return bag_union(a, b, site); }

[[nodiscard]] inline Value bag_intersection(const Value& a, const Value& b, Site site) {
    return detail::checked(Value::sorted_bag(detail::shared(a, b, site)), site);
}

[[nodiscard]] inline Value bag_set_intersection(const Value& a, const Value& b, Site site) {
    return bag_intersection(a, b, site);
}

/// A set, as the first operand is.
[[nodiscard]] inline Value set_bag_intersection(const Value& a, const Value& b, Site site) {
    Values elements;
    for (auto& [element, count] : detail::shared(a, b, site)) elements.push_back(element);
    return detail::checked(Value::sorted_set(std::move(elements)), site);
}

[[nodiscard]] inline Value bag_contains(const Value& bag, const Value& element, Site site) {
    return Value::boolean(detail::count_of(bag, element, site) > 0);
}

[[nodiscard]] inline Value bag_count(const Value& bag, const Value& element, Site site) {
    return detail::saturated(detail::count_of(bag, element, site));
}

/// Each element as often as it occurs.
[[nodiscard]] inline Value bag_size(const Value& bag, Site site) {
    if (!detail::is_countable(bag)) detail::refuse(site, bag);
    return bag.is(Kind::set) ? detail::size_value(bag.items().size()) : detail::saturated(detail::total(bag.as_bag()));
}

[[nodiscard]] inline Value bag_including(const Value& bag, const Value& element, Site site) {
    return detail::with_count(bag, element, detail::saturating_sum(detail::count_of(bag, element, site), 1), site);
}

[[nodiscard]] inline Value bag_excluding(const Value& bag, const Value& element, Site site) {
    const std::uint64_t count = detail::count_of(bag, element, site);
    return detail::with_count(bag, element, count > 0 ? count - 1 : 0, site);
}

[[nodiscard]] inline Value as_sequence(const Value& collection, Site site) {
    return detail::checked(Value::seq(detail::members(collection, site)), site);
}

[[nodiscard]] inline Value as_bag(const Value& collection, Site site) {
    return detail::checked(Value::bag(detail::members(collection, site)), site);
}

[[nodiscard]] inline Value as_set(const Value& collection, Site site) {
    return detail::checked(Value::set(detail::members(collection, site)), site);
}

/// `zero` is the 0 of the domain that the term has: of Integer, Real, or Complex.
[[nodiscard]] inline Value set_sum(const Value& set, const Value& zero, Site site) { return detail::sum(set, zero, site); }
[[nodiscard]] inline Value seq_sum(const Value& seq, const Value& zero, Site site) { return detail::sum(seq, zero, site); }
[[nodiscard]] inline Value bag_sum(const Value& bag, const Value& zero, Site site) { return detail::sum(bag, zero, site); }

}  // namespace groundstate::machine
