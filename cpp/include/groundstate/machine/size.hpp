// A 64-bit number as a size, also on machines where sizes have fewer bits.
#pragma once

#include <cstddef>

namespace groundstate::machine {

/// A number that is known to fit, or of which the lower bits are wanted. A template: where both types are one, no compiler
/// calls the cast useless.
template <class Number>
constexpr std::size_t to_size(Number number) noexcept {
    return static_cast<std::size_t>(number);
}

}  // namespace groundstate::machine
