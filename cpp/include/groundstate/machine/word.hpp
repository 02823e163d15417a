// All locations of a function in one machine word: there are few of them, and their values take a few bits each.
//
// One of five philosophers holds a fork, or none: that takes three bits, and five forks take fifteen. Such a function
// is read with a shift and a mask; a step's next values are one more word, and committing them is one assignment.
//
// A *code* defines how a value is written as a number below `count`. INVARIANT: no other value is ever put or updated;
// the generator has proved it (crates/generate/src/model/storage.rs).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "keys.hpp"
#include "maybe.hpp"
#include "unsequenced.hpp"

namespace groundstate::machine {

/// The first `Count` values of a scalar: truth values, literals of an enum domain, elements.
template <class T, std::uint32_t Count>
struct OrdinalCode {
    using Cell = T;
    static constexpr std::uint64_t count = Count;
    static constexpr std::uint64_t number(T value) noexcept { return ordinal(value); }
    static constexpr T value(std::uint64_t number) noexcept { return from_ordinal<T>(static_cast<std::uint32_t>(number)); }
};

/// The integers from Low to High.
template <std::int64_t Low, std::int64_t High>
struct IntegerCode {
    using Cell = std::int64_t;
    static constexpr std::uint64_t count = static_cast<std::uint64_t>(High) - static_cast<std::uint64_t>(Low) + 1;
    static constexpr std::uint64_t number(std::int64_t value) noexcept {
        return static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(Low);
    }
    static constexpr std::int64_t value(std::uint64_t number) noexcept { return Low + static_cast<std::int64_t>(number); }
};

/// Undef, and the values of another code.
template <class Code>
struct MaybeCode {
    using Cell = Maybe<typename Code::Cell>;
    static constexpr std::uint64_t count = Code::count + 1;
    static constexpr std::uint64_t number(Cell value) noexcept { return value.defined ? Code::number(value.value) + 1 : 0; }
    static constexpr Cell value(std::uint64_t number) noexcept { return number == 0 ? Cell{} : Cell{Code::value(number - 1)}; }
};

/// See the head of this file.
template <Clashes clashes, class Code, class... Dimensions>
class Word : public Placed<Word<clashes, Code, Dimensions...>, typename Code::Cell, Dimensions...> {
  public:
    using Cell = typename Code::Cell;
    static constexpr std::size_t size = (std::size_t{1} * ... * Dimensions::size);
    static constexpr std::size_t bits = std::max<std::size_t>(1, std::bit_width(Code::count - 1));
    static_assert(size * bits <= 64);

    struct Next {
        std::uint64_t values;
        std::uint64_t updated;  ///< a bit for each location; where none can clash, one for all
    };

    Cell cell(std::size_t place) const noexcept { return Code::value(number_at(values_, place)); }
    void put(std::uint32_t number, Cell value) noexcept { set(values_, number, Code::number(value)); }

    Next begin() const noexcept { return {values_, 0}; }
    template <class... Arguments>
    void update(Next& next, Site site, Cell value, const Arguments&... arguments) {
        const std::size_t place = place_of<Dimensions...>(arguments...);
        const std::uint64_t number = Code::number(value);
        if constexpr (clashes == Clashes::possible) {
            const std::uint64_t bit = std::uint64_t{1} << place;
            if ((next.updated & bit) != 0) {
                if (number_at(next.values, place) != number) [[unlikely]] {
                    fail(FaultKind::inconsistent_update, rules_[place], site);
                }
                return;
            }
            next.updated |= bit;
            rules_[place] = site;
        } else {
            next.updated = 1;
        }
        set(next.values, place, number);
    }
    std::uint64_t commit(const Next& next) noexcept {
        values_ = next.values;
        return next.updated;
    }

  private:
    static constexpr std::uint64_t mask = ~std::uint64_t{0} >> (64 - bits);

    static constexpr std::uint64_t number_at(std::uint64_t values, std::size_t place) noexcept {
        return (values >> (place * bits)) & mask;
    }
    static constexpr void set(std::uint64_t& values, std::size_t place, std::uint64_t number) noexcept {
        values = (values & ~(mask << (place * bits))) | (number << (place * bits));
    }

    std::uint64_t values_ = 0;
    std::array<Site, clashes == Clashes::possible ? size : 0> rules_{};
};

}  // namespace groundstate::machine
