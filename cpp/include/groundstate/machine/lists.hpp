// Sequences of literals or elements of a small domain: the lines before locks, the phases of a plan.
//
// An item is its ordinal, in a byte; 255 is undef. Up to 15 of them stand in two machine words, which compilers hold in
// registers; longer lists are on the heap and shared until one of them changes. Bare code has no heap: there a longer
// list is the fault of a limit. Lists are equal exactly when they are equal as sequences of values.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#if !defined(GROUNDSTATE_BARE)
#include <atomic>
#include <memory>
#include <vector>

#include "operands.hpp"
#endif

#include "keys.hpp"
#include "maybe.hpp"

namespace groundstate::machine {

/// A sequence of values of T, or undef, of a domain of at most 255 values.
template <class T>
class List {
  public:
    static constexpr std::size_t in_place = 15;

    constexpr List() = default;
#if !defined(GROUNDSTATE_BARE)
    constexpr List(const List& other) noexcept : low_{other.low_}, high_{other.high_} {
        if (is_long()) [[unlikely]] {
            block()->uses.fetch_add(1, std::memory_order_relaxed);
        }
    }
    constexpr List(List&& other) noexcept : low_{std::exchange(other.low_, 0)}, high_{std::exchange(other.high_, 0)} {}
    constexpr List& operator=(List other) noexcept {
        std::swap(low_, other.low_);
        std::swap(high_, other.high_);
        return *this;
    }
    constexpr ~List() {
        if (is_long()) [[unlikely]] {
            release();
        }
    }
#endif
    static List of(std::initializer_list<Maybe<T>> items) {
        List list;
        for (const Maybe<T>& item : items) {
            list.push_back(item, 0);
        }
        return list;
    }

    std::size_t size() const noexcept {
        if (is_long()) [[unlikely]] {
            return long_items().size();
        }
        return tag();
    }
    bool empty() const noexcept { return tag() == 0; }
    Maybe<T> operator[](std::size_t place) const noexcept { return item(code_at(place)); }
    /// The same of a list that is known to hold no undef.
    T at(std::size_t place) const noexcept { return from_ordinal<T>(static_cast<std::uint32_t>(code_at(place))); }

    /// The first place of an item; size() or more if it is not in the list.
    std::size_t find(const Maybe<T>& wanted) const noexcept { return find_code(wanted.defined ? ordinal(wanted.value) : undef_code); }
    std::size_t find(const T& wanted) const noexcept { return find_code(ordinal(wanted)); }

    void push_back(const T& item, Site site) { push_code(ordinal(item), site); }
    void push_back(const Maybe<T>& item, Site site) { push_code(item.defined ? ordinal(item.value) : undef_code, site); }
    void push_back(Undef, Site site) { push_code(undef_code, site); }
    void append(const List& other, Site site) {
        const std::uint64_t count = tag();
        const std::uint64_t more = other.tag();
        if (count + more > in_place) [[unlikely]] {
            return append_long(other, site);
        }
        const std::uint64_t shift = 8 * (count % 8);
        const std::uint64_t first = other.low_ << shift;
        const std::uint64_t second = (other.high_ & (one - 1)) << shift | (shift == 0 ? 0 : other.low_ >> (64 - shift));
        if (count < 8) {
            low_ |= first;
            high_ |= second;
        } else {
            high_ |= first;
        }
        high_ += more * one;
    }

    friend constexpr bool operator==(const List& a, const List& b) noexcept {
        if (a.is_long() && b.is_long()) [[unlikely]] {
            return same_items(a, b);
        }
        return a.low_ == b.low_ && a.high_ == b.high_;
    }

  private:
    template <class, class, bool>
    friend class ListItems;

    static constexpr std::uint64_t undef_code = 255;
    static constexpr std::uint64_t long_tag = 255;
    static constexpr std::uint64_t one = std::uint64_t{1} << 56;
    static constexpr std::uint64_t ones = 0x0101'0101'0101'0101;
    static constexpr std::uint64_t tops = 0x8080'8080'8080'8080;

    constexpr std::uint64_t tag() const noexcept { return high_ >> 56; }
    constexpr bool is_long() const noexcept { return tag() == long_tag; }

    std::uint64_t code_at(std::size_t place) const noexcept {
        if (is_long()) [[unlikely]] {
            return long_items()[place];
        }
        return ((place < 8 ? low_ : high_) >> (8 * (place & 7))) & 0xff;
    }
    static Maybe<T> item(std::uint64_t code) noexcept {
        return code == undef_code ? Maybe<T>{} : Maybe<T>{from_ordinal<T>(static_cast<std::uint32_t>(code))};
    }
    /// The items from a multiple of eight on, up to eight of them.
    std::uint64_t word_at(std::size_t place) const noexcept {
        if (is_long()) [[unlikely]] {
            return long_word_at(place);
        }
        return place == 0 ? low_ : high_;
    }
    /// The first of eight bytes that is `code`; 8 or more if none is.
    static std::size_t find_in(std::uint64_t word, std::uint64_t code) noexcept {
        const std::uint64_t differs = word ^ (ones * code);
        return static_cast<std::size_t>(std::countr_zero((differs - ones) & ~differs & tops)) / 8;
    }
    std::size_t find_code(std::uint64_t code) const noexcept {
        if (is_long()) [[unlikely]] {
            const auto& all = long_items();
            return static_cast<std::size_t>(std::ranges::find(all, static_cast<std::uint8_t>(code)) - all.begin());
        }
        const std::size_t found = find_in(low_, code);
        // The last byte of the second word is no item.
        return found < 8 ? found : 8 + find_in(high_ & (one - 1), code);
    }
    void push_code(std::uint64_t code, Site site) {
        const std::uint64_t count = tag();
        if (count < 8) [[likely]] {
            low_ |= code << (8 * count);
            high_ += one;
        } else if (count < in_place) {
            high_ = (high_ + one) | (code << (8 * (count - 8)));
        } else {
            push_long(code, site);
        }
    }

    [[gnu::cold, gnu::noinline]] static bool same_items(const List& a, const List& b) noexcept {
        return std::ranges::equal(a.long_items(), b.long_items());
    }
    [[gnu::cold, gnu::noinline]] void append_long(const List& other, Site site) {
        const List items = other;
        const std::size_t count = items.size();
        for (std::size_t place = 0; place < count; ++place) {
            push_code(items.code_at(place), site);
        }
    }
    [[gnu::cold, gnu::noinline]] std::uint64_t long_word_at(std::size_t place) const noexcept {
        std::uint64_t word = 0;
        const std::size_t behind = std::min<std::size_t>(long_items().size(), place + 8);
        for (std::size_t at = place; at < behind; ++at) {
            word |= std::uint64_t{long_items()[at]} << (8 * (at - place));
        }
        return word;
    }

#if defined(GROUNDSTATE_BARE)
    std::array<std::uint8_t, 0> long_items() const noexcept { return {}; }
    [[noreturn]] void push_long(std::uint64_t, Site site) { fail(FaultKind::limit, site, site); }
#else
    struct Block {
        std::atomic<std::uint32_t> uses{1};
        std::vector<std::uint8_t> items;
    };
    Block* block() const noexcept { return std::bit_cast<Block*>(static_cast<std::uintptr_t>(low_)); }
    const std::vector<std::uint8_t>& long_items() const noexcept { return block()->items; }
    [[gnu::cold, gnu::noinline]] void release() noexcept {
        if (block()->uses.fetch_sub(1, std::memory_order_acq_rel) == 1) {
            delete block();
        }
    }
    [[gnu::cold, gnu::noinline]] void push_long(std::uint64_t code, Site site) {
        check_size(size() + 1, site);
        if (!is_long() || block()->uses.load(std::memory_order_acquire) > 1) {
            auto longer = std::make_unique<Block>();
            const std::size_t count = size();
            longer->items.reserve(2 * count);
            for (std::size_t place = 0; place < count; ++place) {
                longer->items.push_back(static_cast<std::uint8_t>(code_at(place)));
            }
            List list;
            list.low_ = std::bit_cast<std::uintptr_t>(longer.release());
            list.high_ = long_tag << 56;
            *this = std::move(list);
        }
        block()->items.push_back(static_cast<std::uint8_t>(code));
    }
#endif

    // INVARIANT: byte i of the two words is item i, byte 15 how many there are, and those between are 0; or byte 15 is 255 and
    // the first word the address of a block.
    std::uint64_t low_ = 0;
    std::uint64_t high_ = 0;
};

// What binders range over. A list that has a place of its own is not copied: nothing changes it meanwhile.

/// The items of a list: Maybe<T>, or plain ones for a list that holds no undef. `Held` is the list or a reference to
/// it.
template <class T, class Held, bool solid>
class ListItems {
  public:
    class Iterator {
      public:
        Iterator(const List<T>& list, std::size_t place) : list_{&list}, place_{place}, word_{list.word_at(place)} {}
        auto operator*() const {
            const std::uint64_t code = word_ & 0xff;
            if constexpr (solid) {
                return from_ordinal<T>(static_cast<std::uint32_t>(code));
            } else {
                return List<T>::item(code);
            }
        }
        Iterator& operator++() {
            word_ >>= 8;
            if (++place_ % 8 == 0) [[unlikely]] {
                word_ = list_->word_at(place_);
            }
            return *this;
        }
        bool operator!=(std::size_t end) const { return place_ != end; }

      private:
        const List<T>* list_;
        std::size_t place_;
        std::uint64_t word_;  ///< the items from here to the next multiple of eight
    };

    explicit ListItems(Held list) : list_{static_cast<Held&&>(list)} {}
    Iterator begin() const { return {list_, 0}; }
    std::size_t end() const { return list_.size(); }

  private:
    Held list_;
};
template <class T>
ListItems<T, const List<T>&, false> items(const List<T>& list) {
    return ListItems<T, const List<T>&, false>{list};
}
template <class T>
ListItems<T, List<T>, false> items(List<T>&& list) {
    return ListItems<T, List<T>, false>{std::move(list)};
}
template <class T>
ListItems<T, const List<T>&, true> solid_items(const List<T>& list) {
    return ListItems<T, const List<T>&, true>{list};
}
template <class T>
ListItems<T, List<T>, true> solid_items(List<T>&& list) {
    return ListItems<T, List<T>, true>{std::move(list)};
}

/// `asSet(list)` of a list that holds no undef and whose domain has at most 64 values: each once, ascending.
template <class T>
class ItemSet {
  public:
    class Iterator {
      public:
        explicit Iterator(std::uint64_t left) : left_{left} {}
        T operator*() const { return from_ordinal<T>(static_cast<std::uint32_t>(std::countr_zero(left_))); }
        Iterator& operator++() {
            left_ &= left_ - 1;
            return *this;
        }
        friend bool operator==(const Iterator&, const Iterator&) = default;

      private:
        std::uint64_t left_;
    };

    explicit ItemSet(const List<T>& list) {
        const std::size_t count = list.size();
        for (std::size_t place = 0; place < count; ++place) {
            all_ |= std::uint64_t{1} << ordinal(list.at(place));
        }
    }
    Iterator begin() const { return Iterator{all_}; }
    Iterator end() const { return Iterator{0}; }

  private:
    std::uint64_t all_ = 0;
};

// Library functions. Positions count from 0.

template <class T>
std::int64_t length(const List<T>& list) noexcept {
    return static_cast<std::int64_t>(list.size());
}
template <class T>
bool is_empty(const List<T>& list) noexcept {
    return list.empty();
}
template <class T, class Wanted>
bool contains(const List<T>& list, const Wanted& wanted) noexcept {
    return list.find(wanted) < list.size();
}
/// The first position of an item; -1 if it is none.
template <class T, class Wanted>
std::int64_t index_of(const List<T>& list, const Wanted& wanted) noexcept {
    const std::size_t found = list.find(wanted);
    return found < list.size() ? static_cast<std::int64_t>(found) : -1;
}
/// `union`: the first, then the second.
template <class T>
List<T> joined(List<T> first, const List<T>& second, Site site) {
    first.append(second, site);
    return first;
}
template <class T, class Item>
List<T> with_last(List<T> list, const Item& item, Site site) {
    list.push_back(item, site);
    return list;
}
template <class T>
Maybe<T> first_of(const List<T>& list, Site site) {
    if (list.empty()) [[unlikely]] {
        fail(FaultKind::bad_operand, site, site);
    }
    return list[0];
}
template <class T>
Maybe<T> last_of(const List<T>& list, Site site) {
    if (list.empty()) [[unlikely]] {
        fail(FaultKind::bad_operand, site, site);
    }
    return list[list.size() - 1];
}
/// All but the first.
template <class T>
List<T> tail_of(const List<T>& list, Site site) {
    if (list.empty()) [[unlikely]] {
        fail(FaultKind::bad_operand, site, site);
    }
    List<T> rest;
    for (std::size_t place = 1; place < list.size(); ++place) {
        rest.push_back(list[place], site);
    }
    return rest;
}

}  // namespace groundstate::machine
