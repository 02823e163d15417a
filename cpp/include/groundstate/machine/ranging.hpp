// Collections that terms build and binders range over: displays, ranges, elements, products, subsets.
//
// The twin of the terms of crates/machine/src/evaluate.rs and of enumerate.rs. Orders are canonical: of several binders or
// components the leftmost varies slowest.
#pragma once

#include <cmath>

#include "number_text.hpp"
#include "operands.hpp"
#include "reals.hpp"

namespace groundstate::machine {

enum class CollectionKind : std::uint8_t { set, seq, bag, map };

/// A collection of a kind; the elements of a map are pairs.
[[nodiscard]] inline Value collection(CollectionKind kind, Values elements) {
    switch (kind) {
        case CollectionKind::set: return Value::set(std::move(elements));
        case CollectionKind::seq: return Value::seq(std::move(elements));
        case CollectionKind::bag: return Value::bag(std::move(elements));
        case CollectionKind::map: break;
    }
    Entries entries;
    for (const Value& pair : elements) {
        if (pair.is(Kind::tuple) && pair.items().size() == 2) entries.emplace_back(pair.items()[0], pair.items()[1]);
    }
    return Value::map(std::move(entries));
}

namespace detail {

[[nodiscard]] inline Values integer_range(std::int64_t low, std::int64_t high, std::int64_t step, Site site) {
    if (step <= 0) fail(FaultKind::bad_operand, site);
    Values numbers;
    if (low > high) return numbers;
    const auto distance = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
    const std::uint64_t size = saturating_sum(distance / static_cast<std::uint64_t>(step), 1);
    check_size(size, site);
    numbers.reserve(size);
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(size); ++i) numbers.push_back(Value::integer(low + i * step));
    return numbers;
}

/// `low`, `low + step`, … each rounded to the decimals of `low` and `step`, so that steps of 0.1 stay exact.
[[nodiscard]] inline Values real_range(double low, double high, double step, Site site) {
    if (step <= 0) fail(FaultKind::bad_operand, site);
    double scale = 1;
    for (int i = std::min(15, std::max(decimals(low), decimals(step))); i > 0; --i) scale *= 10;
    const double size = std::floor(product((high - low) / step, 1.0 + 1e-12) + 1e-9);
    Values numbers;
    if (size < 0) return numbers;
    // For an endless range more than the limit; for one between infinities of one sign, a single number.
    const double steps = std::isnan(size) ? 0.0 : std::min(size, 1e18);
    check_size(static_cast<std::uint64_t>(steps), site);
    for (std::uint64_t i = 0; i <= static_cast<std::uint64_t>(steps); ++i) {
        const double number = std::round((low + product(static_cast<double>(i), step)) * scale) / scale;
        if (!std::isnan(number)) numbers.push_back(Value::real(number));
    }
    return numbers;
}

}  // namespace detail

/// `low : high`, or with a step `low : high, step`; without one `step` is null and counts as 1.
[[nodiscard]] inline Value range(const Value& low, const Value& high, const Value* step, CollectionKind kind, Site site) {
    const Value by = step == nullptr ? Value::integer(1) : *step;
    if (low.is(Kind::integer) && high.is(Kind::integer) && by.is(Kind::integer)) {
        return collection(kind, detail::integer_range(low.as_integer(), high.as_integer(), by.as_integer(), site));
    }
    if (low.is(Kind::real) && high.is(Kind::real)) {
        const std::optional<double> width = detail::as_number(by);
        if (!width) fail(FaultKind::undefined_operand, site);
        return collection(kind, detail::real_range(low.as_real(), high.as_real(), *width, site));
    }
    detail::refuse(site, low, high, by);
}

/// The elements over which a binder ranges, in their order. Those of a set or sequence are not copied.
class Members {
  public:
    /// Of a set or sequence.
    explicit Members(Value collection) noexcept : collection_{std::move(collection)} {}

    [[nodiscard]] auto begin() const noexcept { return collection_.items().begin(); }
    [[nodiscard]] auto end() const noexcept { return collection_.items().end(); }
    [[nodiscard]] std::size_t size() const noexcept { return collection_.items().size(); }
    [[nodiscard]] bool empty() const noexcept { return size() == 0; }
    [[nodiscard]] const Value& operator[](std::size_t i) const noexcept { return collection_.items()[i]; }

  private:
    Value collection_;
};

/// For a bag, each element as often as it occurs; for a map, the pairs of key and value.
[[nodiscard]] inline Members iterable(const Value& collection, Site site) {
    switch (collection.kind()) {
        case Kind::set:
        case Kind::seq: return Members{collection};
        case Kind::bag: {
            Values all;
            for (const auto& [element, count] : collection.as_bag()) all.insert(all.end(), count, element);
            return Members{Value::seq(std::move(all))};
        }
        case Kind::map: {
            Values pairs;
            for (const auto& [key, value] : collection.as_map()) pairs.push_back(Value::tuple({key, value}));
            return Members{Value::seq(std::move(pairs))};
        }
        default: detail::refuse(site, collection);
    }
}

/// The elements of a product domain, from those of its components.
[[nodiscard]] inline Values tuples(const std::vector<Values>& components, Site site) {
    std::uint64_t size = 1;
    for (const Values& component : components) {
        if (__builtin_mul_overflow(size, component.size(), &size)) size = ~std::uint64_t{0};
    }
    check_size(size, site);
    std::vector<Values> rows(1);
    for (const Values& component : components) {
        std::vector<Values> longer;
        for (const Values& row : rows) {
            for (const Value& value : component) {
                longer.push_back(row);
                longer.back().push_back(value);
            }
        }
        rows = std::move(longer);
    }
    Values all;
    all.reserve(rows.size());
    for (Values& row : rows) all.push_back(Value::tuple(std::move(row)));
    return all;
}

/// The elements of a powerset domain, in the order of values.
[[nodiscard]] inline Values subsets(const Values& elements, Site site) {
    check_size(elements.size() >= 64 ? ~std::uint64_t{0} : std::uint64_t{1} << elements.size(), site);
    Values sets;
    for (std::uint64_t mask = 0; mask < std::uint64_t{1} << elements.size(); ++mask) {
        Values chosen;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if ((mask >> i & 1) == 1) chosen.push_back(elements[i]);
        }
        sets.push_back(Value::set(std::move(chosen)));
    }
    std::sort(sets.begin(), sets.end());
    return sets;
}

}  // namespace groundstate::machine
