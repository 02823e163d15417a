// What the channels of PlacingSystem.chart carry that have no domain there: a struct for each, of its name. SI units, radians,
// the base's frame. What the others carry is generated.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <groundstate/frame.hpp>

namespace placing_system {

using Vector6 = std::array<double, 6>;

struct Place {
    double x = 0;
    double y = 0;
};

/// What the camera above the table took.
struct Image {
    groundstate::Frame<640, 480> frame{};
    std::int64_t captured_ns = 0;
};

/// Where the nearest part lies that is not in the row; if there is none, where the last one lay.
struct Parts {
    Place nearest{};
};

/// Where a move of the tool ends.
struct Target {
    std::int64_t number = -1;  ///< of the move
    Place place{};
    double height = 0;
};

struct EncoderToRobot {
    Vector6 position{};
    std::int64_t measured_ns = 0;
};
struct EncoderToMotor {
    Vector6 position{};
    std::int64_t measured_ns = 0;
};

/// Where the joints are to be, and how fast they pass there.
struct RobotToMotor {
    Vector6 position{};
    Vector6 velocity{};
    std::int64_t set_ns = 0;
};

inline bool valid(const Target& target) noexcept {
    return std::isfinite(target.place.x) && std::isfinite(target.place.y) && std::isfinite(target.height);
}

inline bool valid(const RobotToMotor& datum) noexcept {
    for (std::size_t i = 0; i < datum.position.size(); ++i) {
        if (!std::isfinite(datum.position[i]) || !std::isfinite(datum.velocity[i])) {
            return false;
        }
    }
    return true;
}

}  // namespace placing_system
