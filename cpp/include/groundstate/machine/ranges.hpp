// Ranges of binders without building a collection: integers, literals and elements in their order.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "fault.hpp"
#include "keys.hpp"
#include "maybe.hpp"
#include "series.hpp"
#if !defined(GROUNDSTATE_BARE)
#include "operands.hpp"
#endif

namespace groundstate::machine {

/// The first `count` values of a scalar domain: truth values, literals, elements.
template <class T>
class Ordinals {
  public:
    class Iterator {
      public:
        constexpr explicit Iterator(std::uint32_t at) : at_{at} {}
        constexpr T operator*() const { return from_ordinal<T>(at_); }
        constexpr Iterator& operator++() {
            ++at_;
            return *this;
        }
        friend constexpr bool operator==(const Iterator&, const Iterator&) = default;

      private:
        std::uint32_t at_;
    };

    constexpr explicit Ordinals(std::uint32_t count) : count_{count} {}
    constexpr Iterator begin() const { return Iterator{0}; }
    constexpr Iterator end() const { return Iterator{count_}; }

  private:
    std::uint32_t count_;
};

/// What another range goes through, and undef at the end.
template <class Range>
class AndUndef {
  public:
    using Inner = decltype(std::declval<const Range&>().begin());
    using Item = Maybe<std::remove_cvref_t<decltype(*std::declval<Inner&>())>>;

    class Iterator {
      public:
        constexpr Iterator(Inner at, Inner end, bool more) : at_{at}, end_{end}, undef_{more} {}
        constexpr Item operator*() const { return at_ == end_ ? Item{} : Item{*at_}; }
        constexpr Iterator& operator++() {
            if (at_ == end_) {
                undef_ = false;
            } else {
                ++at_;
            }
            return *this;
        }
        friend constexpr bool operator==(const Iterator& a, const Iterator& b) {
            return a.at_ == b.at_ && a.undef_ == b.undef_;
        }

      private:
        Inner at_;
        Inner end_;
        bool undef_;
    };

    constexpr explicit AndUndef(Range range) : range_{std::move(range)} {}
    constexpr Iterator begin() const { return {range_.begin(), range_.end(), true}; }
    constexpr Iterator end() const { return {range_.end(), range_.end(), false}; }

  private:
    Range range_;
};
template <class Range>
constexpr AndUndef<Range> and_undef(Range range) {
    return AndUndef<Range>{std::move(range)};
}

/// `{low : high, step}` of integers.
class Integers {
  public:
    class Iterator {
      public:
        constexpr Iterator(std::int64_t at, std::int64_t step, std::uint64_t left) : at_{at}, step_{step}, left_{left} {}
        constexpr std::int64_t operator*() const { return at_; }
        constexpr Iterator& operator++() {
            if (--left_ > 0) {
                at_ += step_;
            }
            return *this;
        }
        friend constexpr bool operator==(const Iterator& a, const Iterator& b) { return a.left_ == b.left_; }

      private:
        std::int64_t at_;
        std::int64_t step_;
        std::uint64_t left_;
    };

    constexpr Integers(std::int64_t low, std::int64_t high, std::int64_t step, Site site) : low_{low}, step_{step} {
        if (step <= 0) [[unlikely]] {
            fail(FaultKind::bad_operand, site, site);
        }
        if (low <= high) {
            size_ = (static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low)) / static_cast<std::uint64_t>(step) + 1;
        }
        if (size_ > most || (low <= high && size_ == 0)) [[unlikely]] {
            fail(FaultKind::limit, site, site);
        }
    }
    constexpr Integers(std::int64_t low, std::int64_t high) : Integers{low, high, 1, 0} {}

    constexpr Iterator begin() const { return {low_, step_, size_}; }
    constexpr Iterator end() const { return {low_, step_, 0}; }

  private:
    // LIMIT: elements of one collection.
    static constexpr std::uint64_t most = 10'000'000;

    std::int64_t low_;
    std::int64_t step_;
    std::uint64_t size_ = 0;
};

/// The elements of a growing domain as they are now.
template <class T, class Carrier>
auto listed(const Carrier& carrier) {
    Series<T, Carrier::capacity> all;
    carrier.each([&](std::uint32_t element) { all.push(from_ordinal<T>(element), 0); });
    return all;
}

/// The candidates of a choice: at most `Capacity`, 0 if that is not known.
template <class T, std::size_t Capacity>
class Candidates {
  public:
    void add(T candidate, Site) { candidates_[size_++] = candidate; }
    std::size_t size() const noexcept { return size_; }
    const T& operator[](std::size_t place) const noexcept { return candidates_[place]; }

  private:
    std::array<T, Capacity> candidates_;  // only the first `size_` have a value
    std::size_t size_ = 0;
};

#if !defined(GROUNDSTATE_BARE)
template <class T>
class Candidates<T, 0> {
  public:
    void add(T candidate, Site site) {
        candidates_.push(std::move(candidate), site);
        check_size(candidates_.size(), site);
    }
    std::size_t size() const noexcept { return candidates_.size(); }
    const T& operator[](std::size_t place) const noexcept { return candidates_[place]; }

  private:
    Series<T, 0> candidates_;
};
#endif

}  // namespace groundstate::machine
