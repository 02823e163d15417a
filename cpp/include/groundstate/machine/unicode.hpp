// Text as Unicode scalar values: from and to UTF-8, and which of them are white space.
//
// In: UTF-8 that is valid; strings of values are. Strings are indexed by scalar values, as in the language.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace groundstate::machine::detail {

/// Does a byte continue a scalar value?
[[nodiscard]] constexpr bool continues(char byte) noexcept { return (static_cast<unsigned char>(byte) & 0xc0u) == 0x80u; }

/// How many scalar values.
[[nodiscard]] inline std::size_t length(std::string_view text) noexcept {
    std::size_t scalars = 0;
    for (const char byte : text) scalars += continues(byte) ? 0u : 1u;
    return scalars;
}

/// The bytes before the scalar value of that number.
[[nodiscard]] inline std::size_t offset(std::string_view text, std::size_t scalar) noexcept {
    std::size_t at = 0;
    for (; scalar > 0 && at < text.size(); --scalar) {
        do ++at;
        while (at < text.size() && continues(text[at]));
    }
    return at;
}

/// Takes the first scalar value off a text that is not empty.
[[nodiscard]] inline char32_t take_scalar(std::string_view& text) noexcept {
    const auto byte = [&](std::size_t i) { return static_cast<char32_t>(static_cast<unsigned char>(text[i])); };
    const std::size_t size = offset(text, 1);
    char32_t scalar = size == 1 ? byte(0) : byte(0) & (0xffu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) scalar = scalar << 6 | (byte(i) & 0x3fu);
    text.remove_prefix(size);
    return scalar;
}

inline void append_scalar(std::string& text, char32_t scalar) {
    const auto put = [&](char32_t byte) { text.push_back(static_cast<char>(static_cast<unsigned char>(byte))); };
    if (scalar < 0x80) {
        put(scalar);
    } else if (scalar < 0x800) {
        put(0xc0 | scalar >> 6);
        put(0x80 | (scalar & 0x3f));
    } else if (scalar < 0x1'0000) {
        put(0xe0 | scalar >> 12);
        put(0x80 | (scalar >> 6 & 0x3f));
        put(0x80 | (scalar & 0x3f));
    } else {
        put(0xf0 | scalar >> 18);
        put(0x80 | (scalar >> 12 & 0x3f));
        put(0x80 | (scalar >> 6 & 0x3f));
        put(0x80 | (scalar & 0x3f));
    }
}

[[nodiscard]] inline std::u32string scalars(std::string_view text) {
    std::u32string all;
    while (!text.empty()) all.push_back(take_scalar(text));
    return all;
}

/// The property White_Space.
[[nodiscard]] constexpr bool is_white_space(char32_t scalar) noexcept {
    return (scalar >= 0x9 && scalar <= 0xd) || scalar == 0x20 || scalar == 0x85 || scalar == 0xa0 || scalar == 0x1680 ||
           (scalar >= 0x2000 && scalar <= 0x200a) || scalar == 0x2028 || scalar == 0x2029 || scalar == 0x202f ||
           scalar == 0x205f || scalar == 0x3000;
}

/// Without white space anywhere.
[[nodiscard]] inline std::string without_white_space(std::string_view text) {
    std::string kept;
    while (!text.empty()) {
        if (const char32_t scalar = take_scalar(text); !is_white_space(scalar)) append_scalar(kept, scalar);
    }
    return kept;
}

/// Without white space at both ends.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) noexcept {
    std::size_t begin = 0, end = 0;
    bool found = false;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t at = text.size() - rest.size();
        if (is_white_space(take_scalar(rest))) continue;
        if (!found) begin = at;
        found = true;
        end = text.size() - rest.size();
    }
    return text.substr(begin, end - begin);
}

}  // namespace groundstate::machine::detail
