// One driven joint with its encoder, instead of the real one.
//
// The drive is a velocity loop that is already closed: the velocity follows the command with the time constant `lag_s`, as
// fast as the most torque allows (`most_acceleration`). The encoder counts, and its counts are noisy.
#pragma once

#include <algorithm>

#include "random.hpp"

namespace groundstate::plant {

struct JointSettings {
    double lag_s = 0.004;
    double most_acceleration = 12;                   ///< rad/s^2
    double encoder_step = 2 * 3.14159265358979 / 131072;  ///< rad a count
    double encoder_noise = 0;                        ///< deviation, counts
};

class Joint {
  public:
    Joint() noexcept = default;
    Joint(const JointSettings& settings, double position) noexcept : settings_{settings}, position_{position} {}

    void command(double velocity) noexcept { command_ = velocity; }

    /// Lets time pass, in steps much shorter than the lag.
    void pass(double dt) noexcept {
        const double wanted = (command_ - velocity_) / settings_.lag_s;
        acceleration_ = std::clamp(wanted, -settings_.most_acceleration, settings_.most_acceleration);
        position_ += (velocity_ + acceleration_ * dt / 2) * dt;
        velocity_ += acceleration_ * dt;
    }

    double position() const noexcept { return position_; }
    double velocity() const noexcept { return velocity_; }
    double acceleration() const noexcept { return acceleration_; }

    double measured(Random& random) const noexcept {
        const double noise = settings_.encoder_noise > 0 ? settings_.encoder_noise * random.normal() : 0;
        return std::round(position_ / settings_.encoder_step + noise) * settings_.encoder_step;
    }

  private:
    JointSettings settings_{};
    double position_ = 0;
    double velocity_ = 0;
    double acceleration_ = 0;
    double command_ = 0;
};

}  // namespace groundstate::plant
