// What the channels of AssemblySystem.chart carry that have no domain there: a struct for each, of its name. Metres, radians,
// newtons. What the others carry is generated.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <groundstate/frame.hpp>

namespace assembly_system {

/// x, y, turn, and z towards the substrate.
using Axes = std::array<double, 4>;

/// What the microscope took.
struct Image {
    groundstate::Frame<640, 480> frame{};
    std::int64_t captured_ns = 0;
};

/// How the part has to move to lie on the substrate.
struct Correction {
    double x = 0;
    double y = 0;
    double turn = 0;
    std::int64_t captured_ns = 0;
};

/// Where the axes are.
struct Scale {
    Axes position{};
    std::int64_t measured_ns = 0;
};

/// Where the axes are to be.
struct AxisOrder {
    Axes position{};
    std::int64_t set_ns = 0;
};

inline bool valid(const AxisOrder& order) noexcept {
    for (const double axis : order.position) {
        if (!std::isfinite(axis)) {
            return false;
        }
    }
    return true;
}

}  // namespace assembly_system
