// Locations that no `seq` and no turbo rule updates, so that the step is their only unit: cheaper than Locations.
//
// `Location` is a function without arguments, `FewLocations` one with 64 locations at most. `DisjointLocations` are those of which a step never updates one twice with
// different values, `WholeArray` those that a step updates all or not at all. The generator proves which of them a
// function can be (crates/generate/src/form.rs); whatever it cannot prove has the form Locations, which takes all.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>

#include "locations.hpp"

namespace groundstate::machine {

/// The one location of a function without arguments.
template <class Cell>
class Location {
  public:
    std::uint32_t number(Site) const noexcept { return 0; }
    const Cell& read() const noexcept { return value_; }
    Cell& at(std::uint32_t) noexcept { return value_; }

    template <class Visit>
    void each(Visit&& visit) const {
        visit(std::tuple<>{}, value_);
    }

    void update(Site site, Cell value) {
        if (updated_ != 0) {
            if (!(next_ == value)) [[unlikely]] {
                fail(FaultKind::inconsistent_update, rule_, site);
            }
            return;
        }
        next_ = std::move(value);
        rule_ = site;
        updated_ = 1;
    }

    std::size_t commit() {
        const std::size_t count = updated_;
        if (count != 0) {
            value_ = std::move(next_);
            updated_ = 0;
        }
        return count;
    }
    void roll_back() noexcept { updated_ = 0; }
    /// No intermediate state is ever made.
    void swap_original(bool) const noexcept {}

  private:
    Cell value_{};
    Cell next_{};
    Site rule_ = 0;
    std::uint32_t updated_ = 0;
};

/// An array of at most 64 locations: a bit says which of them the step has updated.
template <class Cell, class... Dimensions>
class FewLocations {
  public:
    static constexpr std::size_t size = (std::size_t{1} * ... * Dimensions::size);
    static_assert(size <= 64);

    template <class... Arguments>
    std::uint32_t number(Site site, const Arguments&... arguments) const {
        std::size_t place = 0;
        if (!find_place<Dimensions...>(place, arguments...)) [[unlikely]] {
            fail(FaultKind::limit, site, site);
        }
        return static_cast<std::uint32_t>(place);
    }
    template <class... Arguments>
    Cell read(const Arguments&... arguments) const {
        std::size_t place = 0;
        return find_place<Dimensions...>(place, arguments...) ? values_[place] : Cell{};
    }
    template <class... Arguments>
    const Cell& get(const Arguments&... arguments) const {
        return values_[place_of<Dimensions...>(arguments...)];
    }
    Cell& at(std::uint32_t number) noexcept { return values_[number]; }

    template <class Visit>
    void each(Visit&& visit) const {
        for (std::size_t place = 0; place < size; ++place) {
            visit(arguments_at<Dimensions...>(place), values_[place]);
        }
    }

    template <class... Arguments>
    void update(Site site, Cell value, const Arguments&... arguments) {
        const std::size_t place = place_of<Dimensions...>(arguments...);
        const std::uint64_t bit = std::uint64_t{1} << place;
        if ((updated_ & bit) != 0) {
            if (!(next_[place] == value)) [[unlikely]] {
                fail(FaultKind::inconsistent_update, rules_[place], site);
            }
            return;
        }
        updated_ |= bit;
        next_[place] = std::move(value);
        rules_[place] = site;
    }

    std::size_t commit() {
        std::size_t count = 0;
        for (; updated_ != 0; updated_ &= updated_ - 1) {
            ++count;
            const auto place = static_cast<std::size_t>(std::countr_zero(updated_));
            values_[place] = std::move(next_[place]);
        }
        return count;
    }
    void roll_back() noexcept { updated_ = 0; }
    void swap_original(bool) const noexcept {}

  private:
    std::array<Cell, size> values_{};
    std::array<Cell, size> next_{};
    std::array<Site, size> rules_{};
    std::uint64_t updated_ = 0;
};

/// As Locations, without looking for clashes. INVARIANT: a step updates each location with one value at most.
template <class Cell, class Sparse, std::size_t Capacity, class... Dimensions>
class DisjointLocations : public Locations<Cell, Sparse, Capacity, Dimensions...> {
  public:
    template <class... Arguments>
    void update(Site site, Cell value, const Arguments&... arguments) {
        this->append(this->number(site, arguments...), std::move(value), site);
    }
};

/// Two arrays: the values of this state and of the next one. INVARIANT: a step that updates one location updates all.
/// `Capacity` is its size, or 0 if it stands on the heap.
template <class Cell, std::size_t Capacity, class... Dimensions>
class WholeArray {
  public:
    static constexpr std::size_t size = (std::size_t{1} * ... * Dimensions::size);

    WholeArray() {
        values_.resize(size);
        next_.resize(size);
    }

    template <class... Arguments>
    std::uint32_t number(Site site, const Arguments&... arguments) const {
        std::size_t place = 0;
        if (!find_place<Dimensions...>(place, arguments...)) [[unlikely]] {
            fail(FaultKind::limit, site, site);
        }
        return static_cast<std::uint32_t>(place);
    }
    template <class... Arguments>
    Cell read(const Arguments&... arguments) const {
        std::size_t place = 0;
        return find_place<Dimensions...>(place, arguments...) ? values_[place] : Cell{};
    }
    template <class... Arguments>
    const Cell& get(const Arguments&... arguments) const {
        return values_[place_of<Dimensions...>(arguments...)];
    }
    Cell& at(std::uint32_t number) noexcept { return values_[number]; }

    template <class Visit>
    void each(Visit&& visit) const {
        for (std::size_t number = 0; number < size; ++number) {
            visit(arguments_at<Dimensions...>(number), values_[number]);
        }
    }

    template <class... Arguments>
    void update(Site, Cell value, const Arguments&... arguments) {
        next_[place_of<Dimensions...>(arguments...)] = std::move(value);
        updated_ = true;
    }

    std::size_t commit() {
        if (!updated_) return 0;
        std::swap(values_, next_);
        updated_ = false;
        return size;
    }
    void roll_back() noexcept { updated_ = false; }
    void swap_original(bool) const noexcept {}

  private:
    Series<Cell, Capacity> values_;
    Series<Cell, Capacity> next_;
    bool updated_ = false;
};

}  // namespace groundstate::machine
