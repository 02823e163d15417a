// What stands between a component of a system and the class of its machine: values that go from one to the other, and the fault of a step.
//
// A message holds its datum in `value`. The types of both sides are made of the same domain: enums agree place by place, numbers and
// Booleans are the same types. A value of the machine may be undef; nothing is handed over then.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "machine/fault.hpp"
#include "machine/maybe.hpp"
#include "seen.hpp"

namespace groundstate {

/// A value of one side as a value of the other.
template <class To, class From>
constexpr To converted(const From& from) noexcept {
    if constexpr (std::is_enum_v<To>) {
        return static_cast<To>(static_cast<std::uint32_t>(from));
    } else {
        static_assert(std::is_same_v<To, From>);
        return from;
    }
}

/// What a machine gets for a value of a sensor.
template <class Answer, class From>
constexpr Answer sensed(const From& value) {
    return Answer{converted<decltype(Answer{}.value)>(value)};
}

/// What a machine gets for the datum that was read last; undef if there never was one.
template <class Answer, class T>
Answer carried(const Seen<T>& seen) {
    return seen ? sensed<Answer>(seen->value) : Answer{};
}

/// Takes a value that a machine has decided; false if it is undef.
template <class To, class From>
constexpr bool decided(const From& from, To& to) {
    to = converted<To>(from);
    return true;
}
template <class To, class From>
constexpr bool decided(const machine::Maybe<From>& from, To& to) {
    return from.defined && decided(from.value, to);
}

/// A step that a machine cannot make ends the task, as any exception of a hook does.
inline void made(const machine::Fault& fault, const char* machine) {
    if (fault) {
        throw std::runtime_error(std::string{machine} + " cannot make its step: " + machine::id(fault.kind) + " at place "
                                 + std::to_string(fault.site) + " of its source map");
    }
}

}  // namespace groundstate
