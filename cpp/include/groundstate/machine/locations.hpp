// The locations of one function: their values in the current state, and the updates of the running step.
//
// A *unit* is a rule whose updates must agree among themselves: the whole step, one part of a `seq`, the body of a
// turbo call. Units nest; their updates are consecutive suffixes of one log. `where_` says at which place of the log a
// location's last update stands, so a clash is found in constant time, and nothing must be cleared between steps. The
// updates of a finished part of a `seq` are applied at once and the log keeps what they overwrote; when the `seq` ends
// they are taken back and their net effect joins the enclosing unit. So reading is one array access, in a `seq` too
// (Börger & Stärk 2003, definitions 2.4.5 and 4.1.1; crates/machine/src/update.rs).
//
// Locations over small domains are *dense*: an array whose index is computed from the arguments. All others, and
// arguments outside the array, are *sparse*: numbered as they come up. INVARIANT: number ↔ location is one to one, and
// the log holds at most one update of a location for each unit or sequence that is open.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "keys.hpp"
#include "maybe.hpp"
#include "series.hpp"
#include "size.hpp"

namespace groundstate::machine {

// How one argument becomes an index.

/// A scalar whose ordinals are 0 … Size - 1: a truth value, a literal of an enum domain, an element.
template <class T, std::size_t Size>
struct Below {
    using Type = T;
    static constexpr std::size_t size = Size;
    static constexpr std::size_t index(T value) noexcept { return static_cast<std::size_t>(ordinal(value)); }
    static constexpr T value(std::size_t index) noexcept { return from_ordinal<T>(static_cast<std::uint32_t>(index)); }
};

/// An integer from Low to High.
template <std::int64_t Low, std::int64_t High>
struct Between {
    using Type = std::int64_t;
    static constexpr std::size_t size = static_cast<std::size_t>(High - Low + 1);
    static constexpr std::size_t index(std::int64_t value) noexcept {
        // Below Low it wraps to a number that is too large.
        return to_size(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(Low));
    }
    static constexpr std::int64_t value(std::size_t index) noexcept { return Low + static_cast<std::int64_t>(index); }
};

/// Whatever there is of a domain: never dense.
template <class T>
struct Anywhere {
    using Type = T;
    static constexpr std::size_t size = 0;
    static constexpr std::size_t index(const T&) noexcept { return 1; }
    static constexpr T value(std::size_t) noexcept { return T{}; }
};

/// The values of another dimension, and undef, which has the last place.
template <class Dimension>
struct OrUndef {
    using Type = typename Dimension::Type;
    static constexpr bool has_undef = true;
    static constexpr std::size_t size = Dimension::size + 1;
    static constexpr std::size_t index(const Type& value) noexcept { return Dimension::index(value); }
    static constexpr std::size_t index(const Maybe<Type>& value) noexcept {
        return value.defined ? Dimension::index(value.value) : Dimension::size;
    }
    static constexpr Maybe<Type> value(std::size_t index) noexcept {
        return index < Dimension::size ? Maybe<Type>{Dimension::value(index)} : Maybe<Type>{};
    }
};

// Arguments and places in the array.

/// The place of arguments in an array with these dimensions; false if it has none. Arguments are values of the dimensions'
/// types or Maybe of them.
template <class... Dimensions, class... Arguments>
constexpr bool find_place(std::size_t& place, const Arguments&... arguments) {
    [[maybe_unused]] const auto inside = [&]<class Dimension, class Given>(const Dimension*, const Given& argument) {
        std::size_t index = 0;
        if constexpr (std::is_same_v<Given, Maybe<typename Dimension::Type>>) {
            if (!argument.defined) {
                if constexpr (requires { Dimension::has_undef; }) {
                    place = place * Dimension::size + (Dimension::size - 1);
                    return true;
                } else {
                    return false;
                }
            }
            index = Dimension::index(argument.value);
        } else {
            index = Dimension::index(argument);
        }
        place = place * Dimension::size + index;
        if constexpr (requires { Dimension::has_undef; }) {
            return index + 1 < Dimension::size;
        } else {
            return index < Dimension::size;
        }
    };
    place = 0;
    return (inside(static_cast<const Dimensions*>(nullptr), arguments) && ...);
}

/// The place of arguments that are known to have one.
template <class... Dimensions, class... Arguments>
constexpr std::size_t place_of(const Arguments&... arguments) {
    std::size_t place = 0;
    ((place = place * Dimensions::size + Dimensions::index(arguments)), ...);
    return place;
}

/// The arguments at a place of the array.
template <class... Dimensions>
std::tuple<Argument<typename Dimensions::Type>...> arguments_at(std::size_t place) {
    std::array<std::size_t, sizeof...(Dimensions) + 1> indexes{};
    constexpr std::array<std::size_t, sizeof...(Dimensions) + 1> sizes{Dimensions::size..., 1};
    for (std::size_t dimension = sizeof...(Dimensions); dimension-- > 0;) {
        indexes[dimension] = place % sizes[dimension];
        place /= sizes[dimension];
    }
    return [&]<std::size_t... Places>(std::index_sequence<Places...>) {
        return std::tuple<Argument<typename Dimensions::Type>...>{
            Argument<typename Dimensions::Type>{Dimensions::value(indexes[Places])}...};
    }(std::index_sequence_for<Dimensions...>{});
}

/// One update: the new value of a location, and its rule. Once applied, it holds the value that it overwrote.
template <class Cell>
struct Update {
    std::uint32_t location = 0;
    std::uint32_t previous = 0;  ///< where the location's update before this one stands
    Site rule = 0;
    bool applied = false;
    Cell value{};
};

/// Where a unit or a sequence began; it is given back at its end.
struct Mark {
    std::uint32_t outer = 0;  ///< where the enclosing unit begins
    std::uint32_t from = 0;
};

/// See the head of this file. `Sparse` says how locations outside the array are numbered (keys.hpp); `Capacity` is how many
/// updates the log can hold, 0 if it grows.
template <class Cell, class Sparse, std::size_t Capacity, class... Dimensions>
class Locations {
  public:
    static constexpr std::size_t dense = (std::size_t{1} * ... * Dimensions::size);
    static constexpr std::uint32_t none = 0xffff'ffff;
    using Key = std::tuple<Argument<typename Dimensions::Type>...>;
    using Keys = typename Sparse::template Keys<Key>;

    Locations() {
        values_.resize(dense);
        where_.resize(dense);
    }

    // Reading.

    /// The number of a location, or `none`. Arguments are values of the dimensions' types or Maybe of them.
    template <class... Arguments>
    std::uint32_t find(const Arguments&... arguments) const {
        if constexpr (dense > 0) {
            std::size_t place = 0;
            if (find_place<Dimensions...>(place, arguments...)) [[likely]] {
                return static_cast<std::uint32_t>(place);
            }
        }
        if constexpr (Keys::none) {
            return none;
        } else {
            const std::uint32_t key = keys_.find(Key{arguments...});
            return key == Keys::absent ? none : static_cast<std::uint32_t>(dense) + key;
        }
    }

    /// The same; a location that occurs for the first time gets a number.
    template <class... Arguments>
    std::uint32_t number(Site site, const Arguments&... arguments) {
        const std::uint32_t found = find(arguments...);
        if (found != none) [[likely]] {
            return found;
        }
        if constexpr (Keys::none) {
            fail(FaultKind::limit, site, site);
        } else {
            const std::uint32_t key = keys_.insert(Key{arguments...}, site);
            values_.resize(dense + keys_.size());
            where_.resize(dense + keys_.size());
            return static_cast<std::uint32_t>(dense) + key;
        }
    }

    /// The value of a location, undef if it never had one.
    template <class... Arguments>
    Cell read(const Arguments&... arguments) const {
        const std::uint32_t found = find(arguments...);
        return found == none ? Cell{} : values_[found];
    }

    /// The same for arguments that are known to have a place in the array.
    template <class... Arguments>
    const Cell& get(const Arguments&... arguments) const {
        return values_[place_of<Dimensions...>(arguments...)];
    }

    Cell& at(std::uint32_t number) { return values_[number]; }
    const Cell& at(std::uint32_t number) const { return values_[number]; }
    void put(std::uint32_t number, Cell value) { values_[number] = std::move(value); }

    /// Calls visit(arguments, value) for each location.
    template <class Visit>
    void each(Visit&& visit) const {
        for (std::size_t number = 0; number < dense; ++number) {
            visit(arguments_at<Dimensions...>(number), values_[number]);
        }
        if constexpr (!Keys::none) {
            keys_.each([&](const Key& key, std::uint32_t number) { visit(key, values_[dense + number]); });
        }
    }

    // Updating.

    /// `function(arguments) := value`, by the rule at `site`.
    template <class... Arguments>
    void update(Site site, Cell value, const Arguments&... arguments) {
        push(number(site, arguments...), std::move(value), site);
    }

    void push(std::uint32_t location, Cell value, Site rule) {
        const std::uint32_t held = where_[location];
        if (held >= unit_ && held < log_.size() && log_[held].location == location) {
            if (!(log_[held].value == value)) [[unlikely]] {
                fail(FaultKind::inconsistent_update, log_[held].rule, rule);
            }
            return;
        }
        where_[location] = append(location, std::move(value), rule, held);
    }

    /// Begins a unit.
    Mark open() {
        const Mark mark{unit_, static_cast<std::uint32_t>(log_.size())};
        unit_ = mark.from;
        return mark;
    }

    /// Whether the unit has no update.
    bool empty() const { return log_.size() == unit_; }

    /// Ends a unit by joining its updates to the enclosing one.
    void join(Mark mark) {
        unit_ = mark.outer;
        for (std::size_t place = log_.size(); place-- > mark.from;) {
            where_[log_[place].location] = log_[place].previous;
        }
        std::size_t end = mark.from;
        for (std::size_t place = mark.from; place < log_.size(); ++place) {
            Update<Cell>& update = log_[place];
            const std::uint32_t held = where_[update.location];
            if (held >= unit_ && held < end && log_[held].location == update.location) {
                if (!(log_[held].value == update.value)) [[unlikely]] {
                    fail(FaultKind::inconsistent_update, log_[held].rule, update.rule);
                }
                continue;
            }
            update.previous = held;
            where_[update.location] = static_cast<std::uint32_t>(end);
            if (end != place) {
                log_[end] = std::move(update);
            }
            ++end;
        }
        log_.shrink(end);
    }

    /// Ends a part of the sequence that began at `mark`: its updates make the intermediate state.
    void apply(Mark mark) {
        std::size_t end = unit_;
        for (std::size_t place = unit_; place < log_.size(); ++place) {
            Update<Cell>& update = log_[place];
            const std::uint32_t held = update.previous;
            std::swap(values_[update.location], update.value);
            if (held >= mark.from && held < unit_ && log_[held].location == update.location) {
                log_[held].rule = update.rule;  // an earlier part overwrote it, and keeps what it was
                where_[update.location] = held;
                continue;
            }
            update.applied = true;
            where_[update.location] = static_cast<std::uint32_t>(end);
            if (end != place) {
                log_[end] = std::move(update);
            }
            ++end;
        }
        log_.shrink(end);
        unit_ = static_cast<std::uint32_t>(end);
    }

    /// Ends a sequence, all of whose parts are applied: takes them back and joins the net effect.
    void end(Mark mark) {
        take_back(mark.from);
        join(mark);
    }

    /// Ends a sequence whose updates leave no trace, those of local functions.
    void drop(Mark mark) {
        take_back(mark.from);
        forget(mark);
    }

    /// Ends a unit, leaving its updates out; gives the value of the one location of a function without arguments, if
    /// it was written: the result of a turbo rule.
    std::pair<bool, Cell> take(Mark mark) {
        std::pair<bool, Cell> result{log_.size() > mark.from, Cell{}};
        if (result.first) {
            result.second = log_[mark.from].value;
        }
        forget(mark);
        return result;
    }

    /// Applies the step's updates; tells how many there were.
    std::size_t commit() {
        const std::size_t count = log_.size();
        for (std::size_t place = 0; place < count; ++place) {
            values_[log_[place].location] = std::move(log_[place].value);
        }
        log_.shrink(0);
        return count;
    }

    /// Calls visit(number) for each location that the step updates.
    template <class Visit>
    void each_update(Visit&& visit) const {
        for (const Update<Cell>& update : log_) {
            visit(update.location);
        }
    }

    /// Whether the intermediate state has another value of a location than the state before the step.
    bool is_overwritten(std::uint32_t location) const {
        for (const Update<Cell>& update : log_) {
            if (update.applied && update.location == location) {
                return true;
            }
        }
        return false;
    }

    /// Goes back to the state before the step.
    void roll_back() {
        take_back(0);
        log_.shrink(0);
        unit_ = 0;
    }

    /// Exchanges the intermediate state for the one before the step, or back.
    void swap_original(bool back) {
        const std::size_t count = log_.size();
        for (std::size_t step = 0; step < count; ++step) {
            Update<Cell>& update = log_[back ? step : count - 1 - step];
            if (update.applied) {
                std::swap(values_[update.location], update.value);
            }
        }
    }

    /// Makes all locations undef, and gives their values: local functions at the beginning of their scope.
    auto hide() {
        auto hidden = values_;
        for (std::size_t number = 0; number < values_.size(); ++number) {
            values_[number] = Cell{};
        }
        return hidden;
    }
    template <class Hidden>
    void restore(const Hidden& hidden) {
        for (std::size_t number = 0; number < values_.size(); ++number) {
            values_[number] = number < hidden.size() ? hidden[number] : Cell{};
        }
    }

  protected:
    /// An update at the end of the log; gives its place there.
    std::uint32_t append(std::uint32_t location, Cell value, Site rule, std::uint32_t previous = none) {
        const auto end = static_cast<std::uint32_t>(log_.size());
        log_.push(Update<Cell>{location, previous, rule, false, std::move(value)}, rule);
        return end;
    }

  private:
    void take_back(std::size_t from) {
        for (std::size_t place = log_.size(); place-- > from;) {
            if (log_[place].applied) {
                std::swap(values_[log_[place].location], log_[place].value);
                log_[place].applied = false;
            }
        }
    }

    void forget(Mark mark) {
        for (std::size_t place = log_.size(); place-- > mark.from;) {
            where_[log_[place].location] = log_[place].previous;
        }
        log_.shrink(mark.from);
        unit_ = mark.outer;
    }

    static constexpr std::size_t fixed = Keys::fixed ? dense + Keys::capacity : 0;
    Series<Cell, fixed> values_;
    Series<std::uint32_t, fixed> where_;
    Series<Update<Cell>, Capacity> log_;
    std::uint32_t unit_ = 0;
    [[no_unique_address]] Keys keys_;
};

}  // namespace groundstate::machine
