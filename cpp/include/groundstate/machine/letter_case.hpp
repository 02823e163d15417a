// Texts in capitals and in small letters: the full mappings of Unicode without a language, and the final sigma.
//
// The twin of Rust's `str::to_uppercase` and `str::to_lowercase`, by which the machine computes `toUpper` and `toLower`.
#pragma once

#include <algorithm>
#include <iterator>

#include "letter_case_tables.hpp"
#include "unicode.hpp"

namespace groundstate::machine::detail {

/// Appends the other case of a letter, or the letter, to a text.
template <std::size_t R, std::size_t E>
void append_mapped(std::string& text, char32_t letter, const CaseRun (&runs)[R], const CaseExpansion (&expansions)[E]) {
    const auto expansion = std::lower_bound(std::begin(expansions), std::end(expansions), letter,
                                            [](const CaseExpansion& e, char32_t sought) { return e.from < sought; });
    if (expansion != std::end(expansions) && expansion->from == letter) {
        for (const char32_t scalar : expansion->to) {
            if (scalar != 0) append_scalar(text, scalar);
        }
        return;
    }
    const auto behind = std::upper_bound(std::begin(runs), std::end(runs), letter,
                                         [](char32_t sought, const CaseRun& run) { return sought < run.first; });
    if (behind != std::begin(runs)) {
        const CaseRun& run = *std::prev(behind);
        if (letter <= run.last && (letter - run.first) % run.step == 0) {
            append_scalar(text, static_cast<char32_t>(static_cast<std::int32_t>(letter) + run.distance));
            return;
        }
    }
    append_scalar(text, letter);
}

template <std::size_t N>
[[nodiscard]] bool is_among(char32_t scalar, const ScalarRange (&ranges)[N]) noexcept {
    const auto range = std::lower_bound(std::begin(ranges), std::end(ranges), scalar,
                                        [](const ScalarRange& r, char32_t sought) { return r.last < sought; });
    return range != std::end(ranges) && range->first <= scalar;
}

/// Is the next letter that matters a cased one?
template <typename Iterator>
[[nodiscard]] bool meets_cased(Iterator from, Iterator to) noexcept {
    const auto next = std::find_if(from, to, [](char32_t scalar) { return !is_among(scalar, case_ignorable); });
    return next != to && is_among(*next, cased);
}

[[nodiscard]] inline std::string in_capitals(std::string_view text) {
    std::string capitals;
    while (!text.empty()) append_mapped(capitals, take_scalar(text), to_upper_runs, to_upper_expansions);
    return capitals;
}

[[nodiscard]] inline std::string in_small_letters(std::string_view text) {
    const std::u32string letters = scalars(text);
    std::string small;
    for (std::size_t i = 0; i < letters.size(); ++i) {
        constexpr char32_t capital_sigma = 0x3a3, final_sigma = 0x3c2;
        const auto at = letters.begin() + static_cast<std::ptrdiff_t>(i);
        if (letters[i] == capital_sigma && meets_cased(std::make_reverse_iterator(at), letters.rend()) &&
            !meets_cased(at + 1, letters.end())) {
            append_scalar(small, final_sigma);
        } else {
            append_mapped(small, letters[i], to_lower_runs, to_lower_expansions);
        }
    }
    return small;
}

}  // namespace groundstate::machine::detail
