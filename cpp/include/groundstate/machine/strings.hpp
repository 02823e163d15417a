// Library functions on strings. Positions count Unicode scalar values from 0; a position outside is a fault.
#pragma once

#include <string_view>

#include "letter_case.hpp"
#include "number_text.hpp"
#include "operands.hpp"
#include "text.hpp"
#include "unicode.hpp"

namespace groundstate::machine {

namespace detail {

[[nodiscard]] inline const std::string& text_of(const Value& value, Site site) {
    if (!value.is(Kind::string)) refuse(site, value);
    return value.as_string();
}

/// `b`, `ib`, `a+ib`, `a-ib`, without white space; missing parts are 0, that of `i` itself is 1.
[[nodiscard]] inline std::optional<ComplexParts> read_complex(std::string_view text) noexcept {
    const auto part = [](std::string_view digits, double otherwise) {
        return digits.empty() ? std::optional{otherwise} : read_real(digits);
    };
    const std::size_t i = text.find('i');
    std::string_view before = text.substr(0, i);
    std::optional<double> imaginary = 0.0;
    if (i != std::string_view::npos) {
        const bool negative = !before.empty() && before.back() == '-';
        if (negative || (!before.empty() && before.back() == '+')) before.remove_suffix(1);
        imaginary = part(text.substr(i + 1), 1.0);
        if (imaginary && negative) imaginary = -*imaginary;
    }
    const std::optional<double> real = part(before, 0.0);
    if (!real || !imaginary || std::isnan(*real) || std::isnan(*imaginary)) return {};
    return ComplexParts{*real, *imaginary};
}

/// The integer in a text; an `n` for Naturals may follow it.
[[nodiscard]] inline std::int64_t written_integer(const Value& value, Site site) {
    std::string_view text = trimmed(text_of(value, site));
    while (!text.empty() && text.back() == 'n') text.remove_suffix(1);
    const std::optional<std::int64_t> number = read_integer(text);
    if (!number) fail(FaultKind::bad_operand, site);
    return *number;
}

}  // namespace detail

/// The value as it is printed; a string or character unchanged.
[[nodiscard]] inline Value to_string(const Value& value, const Names& names, Site site) {
    if (value.is(Kind::string)) return detail::checked(value, site);
    if (!value.is(Kind::character)) return detail::checked(Value::string(show(value, names)), site);
    std::string text;
    detail::append_scalar(text, value.as_character());
    return Value::string(std::move(text));
}

[[nodiscard]] inline Value string_size(const Value& text, Site site) {
    return detail::size_value(detail::length(detail::text_of(text, site)));
}

[[nodiscard]] inline Value string_concat(const Value& a, const Value& b, Site site) {
    if (!a.is(Kind::string) || !b.is(Kind::string)) detail::refuse(site, a, b);
    return detail::checked(Value::string(a.as_string() + b.as_string()), site);
}

[[nodiscard]] inline Value to_upper(const Value& text, Site site) {
    return detail::checked(Value::string(detail::in_capitals(detail::text_of(text, site))), site);
}

[[nodiscard]] inline Value to_lower(const Value& text, Site site) {
    return detail::checked(Value::string(detail::in_small_letters(detail::text_of(text, site))), site);
}

/// The first contains the second.
[[nodiscard]] inline Value string_contains(const Value& text, const Value& part, Site site) {
    if (!text.is(Kind::string) || !part.is(Kind::string)) detail::refuse(site, text, part);
    return Value::boolean(text.as_string().find(part.as_string()) != std::string::npos);
}

/// From the first position, included, to the second, excluded.
[[nodiscard]] inline Value sub_string(const Value& text, const Value& from, const Value& to, Site site) {
    if (!text.is(Kind::string) || !from.is(Kind::integer) || !to.is(Kind::integer)) detail::refuse(site, text, from, to);
    std::string_view rest = text.as_string();
    const std::int64_t first = from.as_integer(), behind = to.as_integer();
    if (first < 0 || first > behind || behind > static_cast<std::int64_t>(detail::length(rest))) {
        fail(FaultKind::bad_operand, site);
    }
    rest.remove_prefix(detail::offset(rest, static_cast<std::size_t>(first)));
    const std::string_view part = rest.substr(0, detail::offset(rest, static_cast<std::size_t>(behind - first)));
    return detail::checked(Value::string(std::string{part}), site);
}

/// The parts between occurrences of the separator; the characters, if that is empty.
[[nodiscard]] inline Value split(const Value& text, const Value& separator, Site site) {
    if (!text.is(Kind::string) || !separator.is(Kind::string)) detail::refuse(site, text, separator);
    std::string_view rest = text.as_string();
    const std::string& between = separator.as_string();
    Values parts;
    const auto take = [&](std::size_t size) {
        parts.push_back(Value::string(std::string{rest.substr(0, size)}));
        rest.remove_prefix(std::min(size, rest.size()));
    };
    if (between.empty()) {
        while (!rest.empty()) take(detail::offset(rest, 1));
    } else {
        for (std::size_t at = rest.find(between); at != std::string_view::npos; at = rest.find(between)) {
            take(at);
            rest.remove_prefix(between.size());
        }
        take(rest.size());
    }
    return detail::checked(Value::seq(std::move(parts)), site);
}

[[nodiscard]] inline Value to_integer(const Value& text, Site site) {
    return Value::integer(detail::written_integer(text, site));
}

[[nodiscard]] inline Value to_natural(const Value& text, Site site) {
    const std::int64_t number = detail::written_integer(text, site);
    if (number < 0) fail(FaultKind::bad_operand, site);
    return Value::integer(number);
}

[[nodiscard]] inline Value to_real(const Value& text, Site site) {
    const std::optional<double> number = detail::read_real(detail::trimmed(detail::text_of(text, site)));
    if (!number || !std::isfinite(*number)) fail(FaultKind::bad_operand, site);
    return Value::real(*number);
}

[[nodiscard]] inline Value to_complex(const Value& text, Site site) {
    const std::string compact = detail::without_white_space(detail::text_of(text, site));
    const std::optional<ComplexParts> parts = detail::read_complex(compact);
    if (!parts) fail(FaultKind::bad_operand, site);
    return Value::complex(parts->real, parts->imaginary);
}

/// The first character.
[[nodiscard]] inline Value to_char(const Value& text, Site site) {
    std::string_view rest = detail::text_of(text, site);
    if (rest.empty()) fail(FaultKind::bad_operand, site);
    return Value::character(detail::take_scalar(rest));
}

}  // namespace groundstate::machine
