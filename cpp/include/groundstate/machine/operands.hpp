// The common part of all library functions: the fault of an operand on which they are not defined, and the limit of
// collections.
#pragma once

#include <cstdint>

#include "fault.hpp"
#include "value.hpp"

namespace groundstate::machine {

/// Elements of one collection, bytes of one string; crates/machine/src/limits.rs.
inline constexpr std::uint64_t collection_limit = 10'000'000;

/// Keeps collections within the limit.
inline void check_size(std::uint64_t size, Site site) {
    if (size > collection_limit) fail(FaultKind::limit, site);
}

namespace detail {

/// The fault of a function that is not defined on its operands.
template <typename... Operands>
[[noreturn]] void refuse(Site site, const Operands&... operands) {
    fail((operands.is_undef() || ...) ? FaultKind::undefined_operand : FaultKind::bad_operand, site);
}

[[nodiscard]] inline std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) noexcept {
    return a + b < a ? ~std::uint64_t{0} : a + b;
}

/// How many elements a bag has, each as often as it occurs.
[[nodiscard]] inline std::uint64_t total(const Counts& counts) noexcept {
    std::uint64_t sum = 0;
    for (const auto& [element, count] : counts) sum = saturating_sum(sum, count);
    return sum;
}

/// A result within the limit.
[[nodiscard]] inline Value checked(Value value, Site site) {
    switch (value.kind()) {
        case Kind::set:
        case Kind::seq: check_size(value.items().size(), site); break;
        case Kind::string: check_size(value.as_string().size(), site); break;
        case Kind::map: check_size(value.as_map().size(), site); break;
        case Kind::bag: check_size(total(value.as_bag()), site); break;
        default: break;
    }
    return value;
}

/// A size as an Integer.
[[nodiscard]] inline Value size_value(std::size_t size) noexcept { return Value::integer(static_cast<std::int64_t>(size)); }

}  // namespace detail

}  // namespace groundstate::machine
