// Joints led along set-points, and brought to rest when these are too old: what a motor controller does in each cycle.
//
// A set-point is a position and a velocity at an instant. The joint is given that velocity and, for each radian that the
// measurement differs from where the set-point's line was then, `stiffness` more. Without a fresh set-point or a fresh
// measurement the velocity goes to zero on a ramp. INVARIANT: never faster than `most_velocity`; braking never turns round.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace groundstate::kinematics {

struct FollowerSettings {
    double stiffness = 20;                  ///< 1/s
    std::int64_t most_age_ns = 25'000'000;  ///< of a set-point, and of a measurement
    double braking = 8;                     ///< rad/s^2
    double most_velocity = 3;               ///< rad/s
};

/// Of `N` joints. Who: one thread. Nothing blocks or allocates.
template <int N>
class Follower {
  public:
    using Values = Eigen::Matrix<double, N, 1>;

    explicit Follower(const FollowerSettings& settings = {}) noexcept : settings_{settings} {}

    /// A cycle begins. To be called once in each, before one of those below.
    void begin(std::int64_t now_ns) noexcept {
        dt_ = last_ns_ < 0 ? 0 : static_cast<double>(now_ns - last_ns_) * 1e-9;
        last_ns_ = now_ns;
    }

    bool is_fresh(std::int64_t made_ns) const noexcept { return last_ns_ - made_ns <= settings_.most_age_ns; }

    const Values& follow(const Values& position, const Values& velocity, std::int64_t set_ns, const Values& measured,
                         std::int64_t measured_ns) noexcept {
        // Where the joint should have been when it was measured.
        const Values planned = position + velocity * (static_cast<double>(measured_ns - set_ns) * 1e-9);
        velocity_ = velocity + settings_.stiffness * (planned - measured);
        velocity_ = velocity_.cwiseMax(-settings_.most_velocity).cwiseMin(settings_.most_velocity);
        return velocity_;
    }

    const Values& brake() noexcept {
        const double most = settings_.braking * dt_;
        velocity_ -= velocity_.cwiseMax(-most).cwiseMin(most);
        return velocity_;
    }

  private:
    FollowerSettings settings_;
    Values velocity_ = Values::Zero();
    double dt_ = 0;
    std::int64_t last_ns_ = -1;
};

}  // namespace groundstate::kinematics
