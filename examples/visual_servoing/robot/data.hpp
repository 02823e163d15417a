// What the channels of ControllerSystem.chart carry: a struct for each, of its name. Plain memory, SI units, radians. The modes that
// the operator sees are generated.
//
// `captured_ns` is when the camera took the image that a datum goes back to, on the clock of the run: what its age counts
// from. `valid` is asked before a datum is handed over.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <groundstate/frame.hpp>
#include <groundstate/servo/visual_servo.hpp>

namespace controller_system {

using Vector6 = std::array<double, 6>;

inline bool finite(const Vector6& values) noexcept {
    for (const double value : values) {
        if (!std::isfinite(value)) {
            return false;
        }
    }
    return true;
}

/// Where the four discs are to be seen, and how deep they lie then.
struct Targets {
    groundstate::servo::View desired{};
    std::int64_t number = 0;  ///< from 1 on
};

/// An image, in the channel's own array.
struct CameraToVs {
    groundstate::Frame<640, 480> frame{};
    std::int64_t captured_ns = 0;
    std::uint64_t number = 0;  ///< the camera's number of the frame, from 1 on
};

/// Where the robot is.
struct RobotToVs {
    Vector6 position{};      ///< of the joints
    Vector6 camera_twist{};  ///< commanded at present
    std::int64_t measured_ns = 0;
    bool holding = false;  ///< the set-points are too old: it stands
};

/// The velocity of the camera in its own frame.
struct VsToRobot {
    Vector6 twist{};
    double error = 0;  ///< of the features, in the image plane at distance 1
    std::int64_t captured_ns = 0;
};

/// What the encoders read.
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
    std::int64_t set_ns = 0;       ///< when it was made
    std::int64_t captured_ns = -1;  ///< -1: it goes back to no image
};

inline bool valid(const VsToRobot& datum) noexcept { return finite(datum.twist); }
inline bool valid(const RobotToMotor& datum) noexcept { return finite(datum.position) && finite(datum.velocity); }
inline bool valid(const RobotToVs& datum) noexcept { return finite(datum.position); }
inline bool valid(const EncoderToRobot& datum) noexcept { return finite(datum.position); }
inline bool valid(const EncoderToMotor& datum) noexcept { return finite(datum.position); }

}  // namespace controller_system
