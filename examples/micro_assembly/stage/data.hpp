// What the channels of AssemblySystem.chart carry: a struct for each, of its name. Metres, radians, newtons.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <groundstate/frame.hpp>

namespace assembly_system {

/// x, y, turn, and z towards the substrate.
using Axes = std::array<double, 4>;

enum class Work : std::uint8_t { wait, align, lower, retract };

/// What the microscope took.
struct Image {
    groundstate::Frame<640, 480> frame{};
    std::int64_t captured_ns = 0;
};

/// What is to be done, and how exactly.
struct Recipe {
    std::int64_t number = 0;
    Work work = Work::wait;
    double tolerance = 5e-7;       ///< m
    double turn_tolerance = 1e-3;  ///< rad
};

/// How the part has to move to lie on the substrate.
struct Correction {
    std::int64_t number = 0;
    Work work = Work::wait;
    double x = 0;
    double y = 0;
    double turn = 0;
    int aligned_images = 0;  ///< in a row within the tolerance
    std::int64_t captured_ns = 0;
};

/// What the force sensor feels.
struct Contact {
    double force = 0;
    std::int64_t at_ns = 0;
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

/// How far the stage is.
struct State {
    Work work = Work::wait;
    int aligned_images = 0;
    bool placed = false;     ///< the part lies on the substrate
    bool retracted = false;  ///< it is up again
    bool overload = false;   ///< the force was beyond its bound
    double force = 0;
    std::int64_t at_ns = 0;
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
