// What the channels of TrackingSystem.chart carry that have no domain there: a struct for each, of its name. Angles are pan (to
// the left) and tilt (up), in radians; instants are those of the run's clock. What the others carry is generated.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <groundstate/frame.hpp>

namespace tracking_system {

using Angles = std::array<double, 2>;

/// What the camera took.
struct Image {
    groundstate::Frame<640, 480> frame{};
    std::int64_t captured_ns = 0;
};

/// Where the head looks.
struct HeadAngles {
    Angles position{};
    Angles velocity{};
    std::int64_t measured_ns = 0;
};

/// Where the object is, and where it goes.
struct Track {
    Angles position{};
    Angles velocity{};
    std::int64_t at_ns = 0;  ///< when it was there
};

/// What an image told, for whoever looks on.
struct Sightings {
    std::int64_t captured_ns = 0;
    bool seen = false;
    double off_centre = 0;  ///< pixels between the object and the middle of the image
};

struct EncoderToHead {
    Angles position{};
    std::int64_t measured_ns = 0;
};
struct EncoderToMotor {
    Angles position{};
    std::int64_t measured_ns = 0;
};

/// Where the head is to look, and how fast it passes there.
struct HeadToMotor {
    Angles position{};
    Angles velocity{};
    std::int64_t set_ns = 0;
};

inline bool finite(const Angles& angles) noexcept { return std::isfinite(angles[0]) && std::isfinite(angles[1]); }
inline bool valid(const Track& datum) noexcept { return finite(datum.position) && finite(datum.velocity); }
inline bool valid(const HeadToMotor& datum) noexcept { return finite(datum.position) && finite(datum.velocity); }
inline bool valid(const HeadAngles& datum) noexcept { return finite(datum.position) && finite(datum.velocity); }

}  // namespace tracking_system
