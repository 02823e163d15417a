// Numbers as text: the shortest decimal of a double, and numbers read as the language's library reads them.
//
// The twin of Rust's `{:?}` of f64 and of its parsers of i64 and f64: no locale, no rounding of its own.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace groundstate::machine::detail {

/// 0.d₁d₂d₃… × 10^point, without sign.
struct Decimal {
    std::string digits;
    int point = 0;
};

/// The digits of a text of the form d.ddde±dd, and where its point is.
[[nodiscard]] inline Decimal parted(std::string_view scientific) {
    const std::size_t e = scientific.find('e');
    Decimal result;
    for (const char c : scientific.substr(0, e)) {
        if (c != '.') result.digits.push_back(c);
    }
    // from_chars takes no plus sign.
    const std::string_view exponent = scientific.substr(e + (scientific[e + 1] == '+' ? 2 : 1));
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), result.point);
    ++result.point;
    return result;
}

/// For a finite number other than zero, the shortest digits that read back as the same double; of those the nearest,
/// and of two as near the greater.
[[nodiscard]] inline Decimal decimal(double number) {
    std::array<char, 128> buffer{};
    const double magnitude = std::fabs(number);
    const auto written = [&](auto... precision) {
        const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), magnitude,
                                       std::chars_format::scientific, precision...)
                             .ptr;
        return parted({buffer.data(), static_cast<std::size_t>(end - buffer.data())});
    };
    Decimal result = written();
    // Of two equally near ones, the library gives the even one. Then the exact digits are these, a 5, and zeros; 60 are
    // enough, as no double comes so near to a number of 18 digits without being that.
    const std::size_t count = result.digits.size();
    if (count < 15) return result;
    const std::string exact = written(static_cast<int>(count) + 60).digits;
    const bool between = exact[count] == '5' && exact.find_first_not_of('0', count + 1) == std::string::npos;
    if (between && exact.compare(0, count, result.digits) == 0) ++result.digits.back();
    return result;
}

/// Appends a Real to a text: always with a point or an exponent.
inline void append_real(std::string& text, double number) {
    if (number < 0) text.push_back('-');
    if (std::isinf(number)) {
        text.append("Infinity");
        return;
    }
    if (number == 0) {
        text.append("0.0");
        return;
    }
    const auto [digits, point] = decimal(number);
    const int count = static_cast<int>(digits.size());
    const double magnitude = std::fabs(number);
    if (magnitude >= 1e16 || magnitude < 1e-4) {
        text.push_back(digits[0]);
        if (count > 1) text.append(".").append(digits, 1);
        text.append("e").append(std::to_string(point - 1));
    } else if (point <= 0) {
        text.append("0.").append(static_cast<std::size_t>(-point), '0').append(digits);
    } else if (point >= count) {
        text.append(digits).append(static_cast<std::size_t>(point - count), '0').append(".0");
    } else {
        const std::size_t whole = static_cast<std::size_t>(point);
        text.append(digits, 0, whole).append(".").append(digits, whole);
    }
}

/// The decimals of a number written without exponent.
[[nodiscard]] inline int decimals(double number) {
    if (number == 0 || !std::isfinite(number)) return 0;
    const auto [digits, point] = decimal(number);
    const int places = static_cast<int>(digits.size()) - point;
    return places > 0 ? places : 0;
}

[[nodiscard]] constexpr bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

/// Decimal digits with a sign or none, within 64 bits.
[[nodiscard]] inline std::optional<std::int64_t> read_integer(std::string_view text) noexcept {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return number;
}

[[nodiscard]] inline bool equals_ignoring_case(std::string_view text, std::string_view small) noexcept {
    if (text.size() != small.size()) return false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i] >= 'A' && text[i] <= 'Z' ? static_cast<char>(text[i] - 'A' + 'a') : text[i];
        if (c != small[i]) return false;
    }
    return true;
}

/// What a decimal beyond the range of doubles becomes: infinity, or zero.
[[nodiscard]] inline double beyond_range(std::string_view whole, std::string_view fraction, std::int64_t exponent) noexcept {
    const std::size_t first = whole.find_first_not_of('0');
    const std::size_t first_behind = fraction.find_first_not_of('0');
    const std::int64_t point = first != std::string_view::npos ? static_cast<std::int64_t>(whole.size() - first)
                                                               : -static_cast<std::int64_t>(first_behind);
    return point + exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
}

/// A decimal number, with a sign, a point or an exponent if there are any; or `inf`, `infinity`, `nan` in any case.
[[nodiscard]] inline std::optional<double> read_real(std::string_view text) noexcept {
    const bool negative = !text.empty() && text[0] == '-';
    if (negative || (!text.empty() && text[0] == '+')) text.remove_prefix(1);
    const auto signed_as_written = [negative](double number) { return negative ? -number : number; };
    if (equals_ignoring_case(text, "inf") || equals_ignoring_case(text, "infinity")) {
        return signed_as_written(std::numeric_limits<double>::infinity());
    }
    if (equals_ignoring_case(text, "nan")) return std::numeric_limits<double>::quiet_NaN();

    std::size_t at = 0;
    const auto digits = [&] {
        const std::size_t from = at;
        while (at < text.size() && is_digit(text[at])) ++at;
        return text.substr(from, at - from);
    };
    const std::string_view whole = digits();
    std::string_view fraction;
    if (at < text.size() && text[at] == '.') {
        ++at;
        fraction = digits();
    }
    if (whole.empty() && fraction.empty()) return {};
    std::int64_t exponent = 0;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        const bool down = at < text.size() && text[at] == '-';
        if (down || (at < text.size() && text[at] == '+')) ++at;
        const std::string_view power = digits();
        if (power.empty()) return {};
        constexpr std::int64_t huge = 1'000'000'000'000;
        for (const char digit : power) exponent = std::min(huge, exponent * 10 + (digit - '0'));
        if (down) exponent = -exponent;
    }
    if (at != text.size()) return {};
    if (whole.find_first_not_of('0') == std::string_view::npos && fraction.find_first_not_of('0') == std::string_view::npos) {
        return signed_as_written(0.0);
    }
    double number = 0;
    const auto error = std::from_chars(text.data(), text.data() + text.size(), number).ec;
    return signed_as_written(error == std::errc::result_out_of_range ? beyond_range(whole, fraction, exponent) : number);
}

}  // namespace groundstate::machine::detail
