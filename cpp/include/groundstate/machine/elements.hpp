// The elements of a dynamic domain: the existing ones, and those that the running step makes by `extend`.
//
// Elements are numbered from 0 on. Membership tests see at once what a step makes; binders that range over the domain
// see it from the next part of the enclosing `seq` on; and everything sees it once the step is committed. It takes part
// in units and sequences as locations do (locations.hpp). `Capacity`: how many there can be, 0 if as many as there is
// memory.
#pragma once

#include <cstdint>

#include "locations.hpp"
#include "series.hpp"

namespace groundstate::machine {

/// What the running step has made.
template <std::size_t Capacity>
class Created {
  public:
    static constexpr std::size_t capacity = Capacity;

    Mark open() {
        const Mark mark{unit_, static_cast<std::uint32_t>(made_.size())};
        unit_ = mark.from;
        return mark;
    }
    bool empty() const { return made_.size() == unit_; }
    void join(Mark mark) { unit_ = mark.outer; }
    void apply(Mark) {
        for (std::size_t place = unit_; place < made_.size(); ++place) {
            made_[place].visible = true;
        }
        unit_ = static_cast<std::uint32_t>(made_.size());
    }
    void end(Mark mark) {
        for (std::size_t place = mark.from; place < made_.size(); ++place) {
            made_[place].visible = false;
        }
        unit_ = mark.outer;
    }
    void swap_original(bool back) { original_ = !back; }

  protected:
    struct Made {
        std::uint32_t element = 0;
        bool visible = false;
    };

    void made(std::uint32_t element, Site site) { made_.push(Made{element, false}, site); }

    template <class Visit>
    void each_made(Visit&& visit) const {
        for (std::size_t place = 0; place < made_.size() && !original_; ++place) {
            if (made_[place].visible) {
                visit(made_[place].element);
            }
        }
    }

    void forget() {
        made_.shrink(0);
        unit_ = 0;
        original_ = false;
    }

    Series<Made, Capacity> made_;

  private:
    std::uint32_t unit_ = 0;
    bool original_ = false;
};

/// The elements of a growing abstract domain.
template <std::size_t Capacity>
class Elements : public Created<Capacity> {
  public:
    /// How many elements the domain has from the start on.
    explicit Elements(std::uint32_t count = 0) : count_{count}, fresh_{count} {}

    /// A new element's number.
    std::uint32_t create(Site site) {
        if (fresh_ >= most) [[unlikely]] {
            fail(FaultKind::limit, site, site);
        }
        this->made(fresh_, site);
        return fresh_++;
    }

    /// Calls visit(number) for each element, in the order of their making.
    template <class Visit>
    void each(Visit&& visit) const {
        for (std::uint32_t number = 0; number < count_; ++number) {
            visit(number);
        }
        this->each_made(visit);
    }

    std::size_t commit() {
        const std::size_t count = this->made_.size();
        count_ = fresh_;
        this->forget();
        return count;
    }
    void roll_back() {
        fresh_ = count_;
        this->forget();
    }

  private:
    static constexpr std::uint32_t most = Capacity == 0 ? 50'000'000 : static_cast<std::uint32_t>(Capacity);
    std::uint32_t count_ = 0;
    std::uint32_t fresh_ = 0;
};

/// The elements of a growing subset, as numbers of its base domain, ascending.
template <std::size_t Capacity>
class Subset : public Created<Capacity> {
  public:
    void add(std::uint32_t element, Site site) {
        if (holds(element)) {
            return;
        }
        kept_.push(element, site);
        for (std::size_t place = kept_.size() - 1; place > 0 && kept_[place - 1] > kept_[place]; --place) {
            std::swap(kept_[place - 1], kept_[place]);
        }
    }

    void create(std::uint32_t element, Site site) { this->made(element, site); }

    bool contains(std::uint32_t element) const {
        for (std::size_t place = 0; place < this->made_.size(); ++place) {
            if (this->made_[place].element == element) {
                return true;
            }
        }
        return holds(element);
    }

    template <class Visit>
    void each(Visit&& visit) const {
        for (std::size_t place = 0; place < kept_.size(); ++place) {
            visit(kept_[place]);
        }
        this->each_made(visit);
    }

    std::size_t commit() {
        const std::size_t count = this->made_.size();
        for (std::size_t place = 0; place < count; ++place) {
            add(this->made_[place].element, 0);
        }
        this->forget();
        return count;
    }
    void roll_back() { this->forget(); }

  private:
    bool holds(std::uint32_t element) const {
        std::size_t low = 0;
        std::size_t high = kept_.size();
        while (low < high) {
            const std::size_t middle = (low + high) / 2;
            if (kept_[middle] < element) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        return low < kept_.size() && kept_[low] == element;
    }

    Series<std::uint32_t, Capacity> kept_;
};

}  // namespace groundstate::machine
