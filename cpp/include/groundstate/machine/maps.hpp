// Library functions on maps.
#pragma once

#include <algorithm>

#include "operands.hpp"

namespace groundstate::machine {

namespace detail {

[[nodiscard]] inline const Entries& entries_of(const Value& value, Site site) {
    if (!value.is(Kind::map)) refuse(site, value);
    return value.as_map();
}

/// Where the entry of a key is, or belongs.
template <typename Of>
[[nodiscard]] auto place_of(Of& entries, const Value& key) noexcept {
    return std::lower_bound(entries.begin(), entries.end(), key,
                            [](const auto& entry, const Value& sought) { return entry.first < sought; });
}

}  // namespace detail

/// undef if the key is absent.
[[nodiscard]] inline Value map_at(const Value& map, const Value& key, Site site) {
    if (!map.is(Kind::map)) detail::refuse(site, map, key);
    const auto found = detail::place_of(map.as_map(), key);
    return found != map.as_map().end() && found->first == key ? detail::checked(found->second, site) : Value{};
}

[[nodiscard]] inline Value map_assign(const Value& map, const Value& key, const Value& value, Site site) {
    if (!map.is(Kind::map)) detail::refuse(site, map, key, value);
    Entries entries = map.as_map();
    const auto found = detail::place_of(entries, key);
    if (found != entries.end() && found->first == key) {
        found->second = value;
    } else {
        entries.emplace(found, key, value);
    }
    return detail::checked(Value::sorted_map(std::move(entries)), site);
}

/// Entries of both; those of the second count.
[[nodiscard]] inline Value map_merge(const Value& a, const Value& b, Site site) {
    if (!a.is(Kind::map) || !b.is(Kind::map)) detail::refuse(site, a, b);
    Entries entries = a.as_map();
    entries.insert(entries.end(), b.as_map().begin(), b.as_map().end());
    return detail::checked(Value::map(std::move(entries)), site);
}

[[nodiscard]] inline Value map_size(const Value& map, Site site) {
    return detail::size_value(detail::entries_of(map, site).size());
}

[[nodiscard]] inline Value map_keys(const Value& map, Site site) {
    Values keys;
    for (const auto& [key, value] : detail::entries_of(map, site)) keys.push_back(key);
    return detail::checked(Value::sorted_set(std::move(keys)), site);
}

[[nodiscard]] inline Value map_values(const Value& map, Site site) {
    Values values;
    for (const auto& [key, value] : detail::entries_of(map, site)) values.push_back(value);
    return detail::checked(Value::set(std::move(values)), site);
}

}  // namespace groundstate::machine
