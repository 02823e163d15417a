// What goes through the channels of the tests' system.
#pragma once

#include <cmath>

namespace contention {

struct Goals {
    double where = 0;
};
struct Mode {
    int mode = 0;
};
struct Position {
    double where = 0;
    double again = 0;  // the same; a reader that sees two has a torn datum
};
struct State {
    double where = 0;
};

inline bool valid(const Position& position) noexcept { return std::isfinite(position.where); }

}  // namespace contention
