// What a component sees of a channel when it elaborates, and which data may be handed over at all.
//
// With `bool valid(const T&)`, found by argument-dependent lookup, the user decides which data of a type are valid. A
// datum that is not valid (a NaN in a velocity) is not published; it is counted and recorded, and the consumer keeps
// what it has. Without such a function, floating-point numbers are valid if they are finite, and all other types always
// are.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace groundstate {

/// The newest datum of a channel, in place where the form of the channel allows it: it lasts until the cycle's end.
template <class T>
struct Seen {
    const T* datum = nullptr;    ///< null: nothing came yet
    bool fresh = false;          ///< it was not there in the cycle before
    std::uint64_t sequence = 0;  ///< its number, from 1 on
    std::int64_t stamp_ns = 0;   ///< when it was published, or as its producer stamped it

    explicit operator bool() const noexcept { return datum != nullptr; }
    const T& operator*() const noexcept { return *datum; }
    const T* operator->() const noexcept { return datum; }
};

/// Whether a datum may be handed over.
template <class T>
bool is_valid(const T& datum) noexcept {
    if constexpr (requires { { valid(datum) } -> std::convertible_to<bool>; }) {
        return valid(datum);
    } else if constexpr (std::is_floating_point_v<T>) {
        return std::isfinite(datum);
    } else {
        return true;
    }
}

/// Brings a datum from one place to another that nothing else uses: plain memory is copied, other data are swapped, so
/// that what the two have allocated stays with them.
template <class T>
void move_over(T& from, T& to) noexcept {
    if constexpr (std::is_trivially_copyable_v<T>) {
        to = from;
    } else {
        using std::swap;
        swap(from, to);
    }
}

}  // namespace groundstate
