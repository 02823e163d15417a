// The canonical order of values, and their hash: the derived Ord of crates/machine/src/value.rs.
//
// Part of value.hpp, which includes it. Kinds come first, in the order of `Kind`; then contents.
#pragma once

#include <bit>

#include "size.hpp"
#include "value.hpp"

namespace groundstate::machine {

namespace detail {

/// Doubles are not NaN, and there is one zero, so the order of numbers is the total order.
[[nodiscard]] inline std::strong_ordering order(double a, double b) noexcept {
    return a < b ? std::strong_ordering::less : a > b ? std::strong_ordering::greater : std::strong_ordering::equal;
}

[[nodiscard]] inline std::strong_ordering order(const Value& a, const Value& b) noexcept { return a <=> b; }
[[nodiscard]] inline std::strong_ordering order(std::uint64_t a, std::uint64_t b) noexcept { return a <=> b; }

template <typename Second>
[[nodiscard]] std::strong_ordering order(const std::pair<Value, Second>& a, const std::pair<Value, Second>& b) noexcept {
    const std::strong_ordering first = a.first <=> b.first;
    return first != 0 ? first : order(a.second, b.second);
}

/// Lexicographic.
template <typename Item>
[[nodiscard]] std::strong_ordering order(const std::vector<Item>& a, const std::vector<Item>& b) noexcept {
    const std::size_t common = std::min(a.size(), b.size());
    for (std::size_t i = 0; i < common; ++i) {
        if (const std::strong_ordering item = order(a[i], b[i]); item != 0) return item;
    }
    return a.size() <=> b.size();
}

}  // namespace detail

inline std::strong_ordering operator<=>(const Value& a, const Value& b) noexcept {
    if (a.kind_ != b.kind_) return a.kind_ <=> b.kind_;
    if (a.is_compound() && a.payload_.shared == b.payload_.shared) return std::strong_ordering::equal;
    switch (a.kind_) {
        case Kind::undef: return std::strong_ordering::equal;
        case Kind::boolean: return a.as_boolean() <=> b.as_boolean();
        case Kind::integer: return a.as_integer() <=> b.as_integer();
        case Kind::real: return detail::order(a.as_real(), b.as_real());
        case Kind::enumeration:
        case Kind::element: return a.domain_ != b.domain_ ? a.domain_ <=> b.domain_ : a.index() <=> b.index();
        case Kind::character: return a.as_character() <=> b.as_character();
        case Kind::rule: return a.as_rule() <=> b.as_rule();
        case Kind::complex: {
            const ComplexParts &x = a.as_complex(), &y = b.as_complex();
            const std::strong_ordering real = detail::order(x.real, y.real);
            return real != 0 ? real : detail::order(x.imaginary, y.imaginary);
        }
        case Kind::string: return a.as_string().compare(b.as_string()) <=> 0;
        case Kind::tuple:
        case Kind::seq:
        case Kind::set: return detail::order(a.items(), b.items());
        case Kind::bag: return detail::order(a.as_bag(), b.as_bag());
        case Kind::map: return detail::order(a.as_map(), b.as_map());
    }
    return std::strong_ordering::equal;
}

inline std::uint64_t Value::hash() const noexcept {
    const std::uint64_t start = detail::mixed(0x6a09'e667'f3bc'c908u, static_cast<std::uint64_t>(kind_));
    const auto all = [start](const auto& items, const auto& add) {
        std::uint64_t hash = detail::mixed(start, items.size());
        for (const auto& item : items) hash = add(hash, item);
        return hash;
    };
    const auto add_value = [](std::uint64_t hash, const Value& item) { return detail::mixed(hash, item.hash()); };
    switch (kind_) {
        case Kind::undef: return start;
        case Kind::boolean: return detail::mixed(start, as_boolean() ? 1 : 0);
        case Kind::integer: return detail::mixed(start, static_cast<std::uint64_t>(as_integer()));
        case Kind::real: return detail::mixed(start, std::bit_cast<std::uint64_t>(as_real()));
        case Kind::enumeration:
        case Kind::element: return detail::mixed(detail::mixed(start, domain_), index());
        case Kind::character: return detail::mixed(start, as_character());
        case Kind::rule: return detail::mixed(start, as_rule());
        case Kind::complex: {
            const std::uint64_t real = detail::mixed(start, std::bit_cast<std::uint64_t>(as_complex().real));
            return detail::mixed(real, std::bit_cast<std::uint64_t>(as_complex().imaginary));
        }
        case Kind::string:
            return all(as_string(), [](std::uint64_t hash, char byte) {
                return detail::mixed(hash, static_cast<unsigned char>(byte));
            });
        case Kind::tuple:
        case Kind::seq:
        case Kind::set: return all(items(), add_value);
        case Kind::bag:
            return all(as_bag(), [&](std::uint64_t hash, const auto& item) {
                return detail::mixed(add_value(hash, item.first), item.second);
            });
        case Kind::map:
            return all(as_map(), [&](std::uint64_t hash, const auto& entry) {
                return add_value(add_value(hash, entry.first), entry.second);
            });
    }
    return start;
}

}  // namespace groundstate::machine

template <>
struct std::hash<groundstate::machine::Value> {
    std::size_t operator()(const groundstate::machine::Value& value) const noexcept {
        return groundstate::machine::to_size(value.hash());
    }
};
