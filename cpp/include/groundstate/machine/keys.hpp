// The arguments of locations that no array holds, numbered as they come up.
//
// In: tuples of arguments. Out: numbers from 0 on, in the order of first use, never given back. `Growing` keeps as many
// as there is memory, `AtMost<N>` keeps N of them in place, `Nowhere` none: for a function whose array holds all
// locations.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#if !defined(GROUNDSTATE_BARE)
#include <memory>
#include <vector>

#include "value.hpp"
#endif

#include "maybe.hpp"
#include "size.hpp"

namespace groundstate::machine {

// Ordinals of scalars: the place of a truth value or literal in its domain, the number of an element.

constexpr std::uint32_t ordinal(bool value) noexcept { return value ? 1 : 0; }
template <class T>
    requires std::is_enum_v<T>
constexpr std::uint32_t ordinal(T value) noexcept {
    return static_cast<std::uint32_t>(value);
}
template <class T>
    requires requires(T value) { value.element; }
constexpr std::uint32_t ordinal(T value) noexcept {
    return value.element;
}

template <class T>
constexpr T from_ordinal(std::uint32_t ordinal) noexcept {
    if constexpr (std::is_same_v<T, bool>) {
        return ordinal != 0;
    } else if constexpr (std::is_enum_v<T>) {
        return static_cast<T>(ordinal);
    } else {
        return T{ordinal};
    }
}

/// What a location keeps of an argument.
template <class T>
struct Kept {
    using Type = Maybe<T>;
};
#if !defined(GROUNDSTATE_BARE)
template <>
struct Kept<Value> {
    using Type = Value;
};
#endif
template <class T>
using Argument = typename Kept<T>::Type;

/// No other locations.
struct Nowhere {
    template <class Key>
    struct Keys {
        static constexpr bool none = true;
        static constexpr bool fixed = true;
        static constexpr std::size_t capacity = 0;
    };
};

/// At most Capacity other locations. They are searched one after the other: for a few.
template <std::size_t Capacity>
struct AtMost {
    template <class Key>
    class Keys {
      public:
        static constexpr bool none = Capacity == 0;
        static constexpr bool fixed = true;
        static constexpr std::size_t capacity = Capacity;
        static constexpr std::uint32_t absent = 0xffff'ffff;

        std::uint32_t size() const noexcept { return size_; }
        std::uint32_t find(const Key& key) const {
            for (std::uint32_t number = 0; number < size_; ++number) {
                if (keys_[number] == key) {
                    return number;
                }
            }
            return absent;
        }
        std::uint32_t insert(const Key& key, Site site) {
            if (size_ == Capacity) [[unlikely]] {
                fail(FaultKind::limit, site, site);
            }
            keys_[size_] = key;
            return size_++;
        }
        template <class Visit>
        void each(Visit&& visit) const {
            for (std::uint32_t number = 0; number < size_; ++number) {
                visit(keys_[number], number);
            }
        }

      private:
        std::array<Key, Capacity> keys_{};
        std::uint32_t size_ = 0;
    };
};

#if !defined(GROUNDSTATE_BARE)
inline std::size_t hash_of(const Value& value) { return value.hash(); }
template <class T>
std::size_t hash_of(const Maybe<T>& value) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
        return std::hash<T>{}(value.value);
    } else {
        return ordinal(value.value);
    }
}

/// As many other locations as there is memory.
struct Growing {
    template <class Key>
    class Keys {
      public:
        static constexpr bool none = false;
        static constexpr bool fixed = false;
        static constexpr std::size_t capacity = 0;
        static constexpr std::uint32_t absent = 0xffff'ffff;

        std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(keys_.size()); }

        std::uint32_t find(const Key& key) const {
            if (keys_.empty()) {
                return absent;
            }
            for (std::size_t slot = hash(key) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
                const std::uint32_t number = slots_[slot];
                if (number == absent || keys_[number] == key) {
                    return number;
                }
            }
        }

        std::uint32_t insert(const Key& key, Site site) {
            if (keys_.size() >= most) [[unlikely]] {
                fail(FaultKind::limit, site, site);
            }
            keys_.push_back(key);
            if (2 * keys_.size() > slots_.size()) {
                slots_.assign(slots_.empty() ? 16 : 2 * slots_.size(), absent);
                for (std::uint32_t number = 0; number < size(); ++number) {
                    place(number);
                }
            } else {
                place(size() - 1);
            }
            return size() - 1;
        }

        template <class Visit>
        void each(Visit&& visit) const {
            for (std::uint32_t number = 0; number < size(); ++number) {
                visit(keys_[number], number);
            }
        }

      private:
        // LIMIT: as many locations as the machine allows.
        static constexpr std::size_t most = 50'000'000;

        static std::size_t hash(const Key& key) {
            std::uint64_t hash = 0;
            std::apply([&](const auto&... parts) { ((hash = (hash ^ hash_of(parts)) * 0x9e37'79b9'7f4a'7c15), ...); }, key);
            return to_size(hash ^ (hash >> 32));
        }

        void place(std::uint32_t number) {
            std::size_t slot = hash(keys_[number]) & (slots_.size() - 1);
            while (slots_[slot] != absent) {
                slot = (slot + 1) & (slots_.size() - 1);
            }
            slots_[slot] = number;
        }

        std::vector<Key> keys_;
        std::vector<std::uint32_t> slots_;
    };
};
#endif

}  // namespace groundstate::machine
