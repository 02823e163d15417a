// What the channels of PlacingSystem.chart carry: a struct for each, of its name. SI units, radians, the base's frame.
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

/// Where parts lie on the table.
struct Parts {
    static constexpr std::size_t most = 8;
    std::array<Place, most> places{};
    std::size_t count = 0;
    std::int64_t captured_ns = 0;
};

/// What the robot is to do next: bring the tool to a place above the table, or close or open the jaw.
struct Moves {
    enum class Kind : std::uint8_t { go, close, open };
    std::int64_t number = 0;  ///< from 1 on
    Kind kind = Kind::go;
    Place place{};
    double height = 0;
};

/// How far the robot is.
struct Progress {
    std::int64_t done = 0;  ///< the number of the last move done
    bool holds = false;     ///< something is in the jaw
    std::int64_t at_ns = 0;
};

struct JawOrder {
    bool closed = false;
};

/// What the jaw says.
struct Grip {
    bool closed = false;  ///< it has come to its end
    bool open = false;
    bool holds = false;
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

inline bool valid(const Moves& move) noexcept {
    return std::isfinite(move.place.x) && std::isfinite(move.place.y) && std::isfinite(move.height);
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
