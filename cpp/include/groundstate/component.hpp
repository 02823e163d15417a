// What stands between a component of a system and the class of its machine: values that go from one to the other, and the fault of a step.
//
// A message holds its datum in `value`, and in `known` whether there is one: undef goes through a channel as every value does. The types
// of both sides are made of the same domain: enums agree place by place, numbers and Booleans are the same types; a tuple is one of the
// machine's dynamic values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

// First, since a kind of values is called as a constant of the next header, of which compilers would warn.
#include "machine/value.hpp"

#include "machine/fault.hpp"
#include "machine/maybe.hpp"
#include "seen.hpp"
#include "tuple.hpp"

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

/// A datum as a machine's dynamic value. `Domains::of` is the number that an enum's domain has in the machine. May allocate.
template <class Domains, class From>
machine::Value boxed(const From& datum) {
    if constexpr (is_tuple<From>) {
        machine::Values parts;
        datum.each([&](const auto& part) { parts.push_back(boxed<Domains>(part)); });
        return machine::Value::tuple(std::move(parts));
    } else if constexpr (std::is_enum_v<From>) {
        return machine::Value::enumeration(Domains::of(datum), static_cast<std::uint32_t>(datum));
    } else if constexpr (std::is_same_v<From, bool>) {
        return machine::Value::boolean(datum);
    } else if constexpr (std::is_floating_point_v<From>) {
        return machine::Value::real(datum);
    } else {
        return machine::Value::integer(datum);
    }
}

/// Takes a machine's dynamic value; false if it, or a part of it, is undef.
template <class To>
bool unboxed(const machine::Value& value, To& to) {
    if (value.is_undef()) {
        return false;
    }
    if constexpr (is_tuple<To>) {
        bool whole = true;
        std::size_t at = 0;
        to.each([&](auto& part) { whole = unboxed(value.items()[at++], part) && whole; });
        return whole;
    } else if constexpr (std::is_enum_v<To>) {
        to = static_cast<To>(value.index());
    } else if constexpr (std::is_same_v<To, bool>) {
        to = value.as_boolean();
    } else if constexpr (std::is_floating_point_v<To>) {
        to = value.is(machine::Kind::integer) ? static_cast<To>(value.as_integer()) : static_cast<To>(value.as_real());
    } else {
        to = value.as_integer();
    }
    return true;
}

/// What a machine gets for a value of a sensor.
template <class Answer, class Domains = void, class From>
constexpr Answer sensed(const From& value) {
    if constexpr (std::is_same_v<Answer, machine::Value>) {
        return boxed<Domains>(value);
    } else {
        return Answer{converted<decltype(Answer{}.value)>(value)};
    }
}

/// What a machine gets for the datum that was read last; undef if it says so, or there never was one.
template <class Answer, class Domains = void, class T>
Answer carried(const Seen<T>& seen) {
    return seen && seen->known ? sensed<Answer, Domains>(seen->value) : Answer{};
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
template <class To>
bool decided(const machine::Value& from, To& to) {
    return unboxed(from, to);
}

/// A step that a machine cannot make ends the task, as any exception of a hook does.
inline void made(const machine::Fault& fault, const char* machine) {
    if (fault) {
        throw std::runtime_error(std::string{machine} + " cannot make its step: " + machine::id(fault.kind) + " at place "
                                 + std::to_string(fault.site) + " of its source map");
    }
}

}  // namespace groundstate
