// Locations that no `seq` and no turbo rule updates, so that the step is their only unit: cheaper than Locations.
//
// `Location` is a function without arguments, `FewLocations` one with 64 locations at most, `Word` (word.hpp) one whose
// values all fit in a machine word. `WholeArray` holds locations of which a step updates all or none,
// `DisjointLocations` those of which a step never updates one twice with different values. The generator proves which
// of them a function can be (crates/generate/src/model/form.rs). If it can prove nothing, the function has the form
// Locations, which fits all.
//
// All but the last keep what they know of a running step in a `Next`, which `begin` gives and `commit` takes. It is a
// local variable of the step, so compilers hold it in registers; a step that fails just leaves it. `commit` returns a
// number other than 0 if the step has updated something.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "locations.hpp"

namespace groundstate::machine {

/// Whether updates of one step may clash; if they cannot, no check is made.
enum class Clashes : bool { impossible, possible };

/// The common part of all forms whose locations are numbered by their place in an array. `Form` has `cell(place)`.
template <class Form, class Cell, class... Dimensions>
class Placed {
  public:
    static constexpr std::size_t size = (std::size_t{1} * ... * Dimensions::size);

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
        return find_place<Dimensions...>(place, arguments...) ? Cell{form().cell(place)} : Cell{};
    }
    template <class... Arguments>
    decltype(auto) get(const Arguments&... arguments) const {
        return form().cell(place_of<Dimensions...>(arguments...));
    }
    template <class Visit>
    void each(Visit&& visit) const {
        for (std::size_t place = 0; place < size; ++place) {
            visit(arguments_at<Dimensions...>(place), form().cell(place));
        }
    }

  private:
    const Form& form() const noexcept { return static_cast<const Form&>(*this); }
};

/// Locations that no rule updates.
template <class Cell, class... Dimensions>
class Fixed : public Placed<Fixed<Cell, Dimensions...>, Cell, Dimensions...> {
  public:
    const Cell& cell(std::size_t place) const noexcept { return values_[place]; }
    void put(std::uint32_t number, Cell value) noexcept { values_[number] = std::move(value); }

  private:
    std::array<Cell, Fixed::Placed::size> values_{};
};

/// The one location of a function without arguments.
template <Clashes clashes, class Cell>
class Location : public Placed<Location<clashes, Cell>, Cell> {
  public:
    struct Next {
        Cell value;
        Site rule;  ///< that updates it; 0: none
    };

    const Cell& cell(std::size_t) const noexcept { return value_; }
    void put(std::uint32_t, Cell value) noexcept { value_ = std::move(value); }

    Next begin() const {
        if constexpr (copied) {
            return {value_, 0};
        } else {
            return {Cell{}, 0};
        }
    }
    void update(Next& next, Site site, Cell value) const {
        if (clashes == Clashes::possible && next.rule != 0) {
            if (!(next.value == value)) [[unlikely]] {
                fail(FaultKind::inconsistent_update, next.rule, site);
            }
            return;
        }
        next.value = std::move(value);
        next.rule = site;
    }
    std::uint64_t commit(Next& next) {
        if (copied || next.rule != 0) {
            value_ = std::move(next.value);
        }
        return next.rule;
    }

  private:
    // What is copied in no time needs no branch at the end of a step.
    static constexpr bool copied = std::is_trivially_copyable_v<Cell>;

    Cell value_{};
};

/// An array of at most 64 locations: a bit says which of them the step has updated.
template <Clashes clashes, class Cell, class... Dimensions>
class FewLocations : public Placed<FewLocations<clashes, Cell, Dimensions...>, Cell, Dimensions...> {
  public:
    static constexpr std::size_t size = (std::size_t{1} * ... * Dimensions::size);
    static_assert(size <= 64);

    struct Next {
        std::uint64_t updated = 0;
    };

    const Cell& cell(std::size_t place) const noexcept { return values_[place]; }
    void put(std::uint32_t number, Cell value) noexcept { values_[number] = std::move(value); }

    Next begin() const noexcept { return {}; }
    template <class... Arguments>
    void update(Next& next, Site site, Cell value, const Arguments&... arguments) {
        const std::size_t place = place_of<Dimensions...>(arguments...);
        const std::uint64_t bit = std::uint64_t{1} << place;
        if constexpr (clashes == Clashes::possible) {
            if ((next.updated & bit) != 0) {
                if (!(next_[place] == value)) [[unlikely]] {
                    fail(FaultKind::inconsistent_update, rules_[place], site);
                }
                return;
            }
            rules_[place] = site;
        }
        next.updated |= bit;
        next_[place] = std::move(value);
    }
    std::uint64_t commit(Next& next) {
        for (std::uint64_t left = next.updated; left != 0; left &= left - 1) {
            const auto place = static_cast<std::size_t>(std::countr_zero(left));
            values_[place] = std::move(next_[place]);
        }
        return next.updated;
    }

  private:
    std::array<Cell, size> values_{};
    std::array<Cell, size> next_{};
    std::array<Site, clashes == Clashes::possible ? size : 0> rules_{};
};

/// Like Locations, without looking for clashes. INVARIANT: a step updates each location with at most one value.
template <class Cell, class Sparse, std::size_t Capacity, class... Dimensions>
class DisjointLocations : public Locations<Cell, Sparse, Capacity, Dimensions...> {
  public:
    template <class... Arguments>
    void update(Site site, Cell value, const Arguments&... arguments) {
        this->append(this->number(site, arguments...), std::move(value), site);
    }
};

/// Two arrays: the values of this state and of the next one. INVARIANT: a step that updates one location updates all.
/// `Capacity` is its size, or 0 if it is on the heap.
template <class Cell, std::size_t Capacity, class... Dimensions>
class WholeArray : public Placed<WholeArray<Cell, Capacity, Dimensions...>, Cell, Dimensions...> {
  public:
    struct Next {
        bool updated = false;
    };

    WholeArray() {
        values_.resize(this->size);
        next_.resize(this->size);
    }

    const Cell& cell(std::size_t place) const noexcept { return values_[place]; }
    void put(std::uint32_t number, Cell value) noexcept { values_[number] = std::move(value); }

    Next begin() const noexcept { return {}; }
    template <class... Arguments>
    void update(Next& next, Site, Cell value, const Arguments&... arguments) {
        next_[place_of<Dimensions...>(arguments...)] = std::move(value);
        next.updated = true;
    }
    std::uint64_t commit(Next& next) {
        if (next.updated) {
            std::swap(values_, next_);
        }
        return next.updated ? 1 : 0;
    }

  private:
    Series<Cell, Capacity> values_;
    Series<Cell, Capacity> next_;
};

}  // namespace groundstate::machine
