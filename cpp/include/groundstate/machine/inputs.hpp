// What a step takes from outside: monitored and shared locations, the clock, the depth of calls.
//
// Each location is asked for once a step at most, and holds the answer until the next step begins.
#pragma once

#include <array>
#include <cstdint>

#include "locations.hpp"

namespace groundstate::machine {

/// A unit of the clock.
enum class TimeUnit : std::uint8_t { nanoseconds, milliseconds, seconds };

/// What the environment answered, and in which step.
template <class Cell>
struct Answer {
    Cell value{};
    std::uint64_t step = 0;

    friend bool operator==(const Answer&, const Answer&) = default;
};

/// The locations of a monitored function. See `Locations` for the parameters.
template <class Cell, class Sparse, class... Dimensions>
class Inputs {
  public:
    /// The answer of the step, asked for by `ask()` unless that was done already.
    template <class Ask, class... Arguments>
    Cell read(std::uint64_t step, Site site, Ask&& ask, const Arguments&... arguments) {
        const std::uint32_t number = answers_.number(site, arguments...);
        if (answers_.at(number).step != step) {
            Cell given = ask();
            answers_.at(number) = Answer<Cell>{std::move(given), step};
        }
        return answers_.at(number).value;
    }

    /// The answer of that step; none if it was not asked for in that step, or was asked for in a later one.
    template <class... Arguments>
    const Cell* answer(std::uint64_t step, const Arguments&... arguments) const {
        const std::uint32_t number = answers_.find(arguments...);
        return number != answers_.none && answers_.at(number).step == step ? &answers_.at(number).value : nullptr;
    }

  private:
    Locations<Answer<Cell>, Sparse, 1, Dimensions...> answers_;
};

/// The locations of a shared function: asked for as long as they have no value.
template <class Cell, class Sparse, std::size_t Capacity, class... Dimensions>
class SharedLocations {
  public:
    /// The value; for a location that never had one, what `first()` gives: the initial value or the environment's.
    template <class First, class... Arguments>
    Cell read(Site site, First&& first, const Arguments&... arguments) {
        const std::uint32_t number = locations.number(site, arguments...);
        if (locations.at(number) == Cell{} && !given(number) && !locations.is_overwritten(number)) {
            Cell value = first();
            locations.at(number) = std::move(value);
            give(number);
        }
        return locations.at(number);
    }

    /// An update by a rule.
    template <class... Arguments>
    void write(Site site, Cell value, const Arguments&... arguments) {
        locations.update(site, std::move(value), arguments...);
    }

    /// Applies the step's updates; returns how many there were. An updated location is not asked for again, even if it
    /// is undef.
    std::size_t commit() {
        locations.each_update([&](std::uint32_t number) { give(number); });
        return locations.commit();
    }

    /// The environment's part, between steps; and the initial state.
    template <class... Arguments>
    void set(Site site, Cell value, const Arguments&... arguments) {
        const std::uint32_t number = locations.number(site, arguments...);
        locations.at(number) = std::move(value);
        give(number);
    }

    Locations<Cell, Sparse, Capacity, Dimensions...> locations;

  private:
    bool given(std::uint32_t number) const { return number < given_.size() && given_[number]; }
    void give(std::uint32_t number) {
        if (number >= given_.size()) {
            given_.resize(number + 1);
        }
        given_[number] = true;
    }

    using All = Locations<Cell, Sparse, Capacity, Dimensions...>;
    Series<bool, All::Keys::fixed ? All::dense + All::Keys::capacity : 0> given_;
};

/// Begins a call of a procedure or definition that may call itself; it ends by `--depth`. A step begins at depth 0, so a
/// fault need not end the calls it leaves.
inline void enter(std::uint32_t& depth, Site site) {
    // LIMIT: calls inside each other, as the machine has it.
    constexpr std::uint32_t most = 10'000;
    if (depth >= most) [[unlikely]] {
        fail(FaultKind::limit, site, site);
    }
    ++depth;
}

}  // namespace groundstate::machine
