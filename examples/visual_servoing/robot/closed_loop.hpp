// The controller and the cell in one loop, for so long, in virtual or real time.
//
// In: time, seed, disturbances. Out: everything that was recorded, and how near camera and features came to the last goal.
// INVARIANT: in virtual time a run depends on the settings alone; two runs have the same recordings, bit by bit.
#pragma once

#include <groundstate/closed_loop/disturbances.hpp>
#include <groundstate/closed_loop/run.hpp>

#include "hooks.hpp"

namespace controller_system {

using groundstate::closed_loop::Disturbances;

/// How the hook of visual servoing fails.
enum class HookFault { none, throws, hangs, waits, not_a_number };

struct LoopSettings {
    groundstate::closed_loop::RunSettings run{};
    Disturbances disturbances{};
    HookFault hook_fault = HookFault::none;
    double hook_fails_s = 1;    ///< from then on
    std::vector<Goal> goals{};  ///< if empty the example's, the second one after half of the time
};

/// Straight above the target; then nearer, from aside and turned.
std::vector<Goal> example_goals(std::int64_t second_ns);

/// What a run left behind.
struct Loop {
    std::unique_ptr<Cell> cell;
    std::unique_ptr<ServoingByImages> servoing;
    std::unique_ptr<ArmController> robot;
    std::unique_ptr<JointDrives> motor;
    std::vector<Goal> goals{};
    groundstate::RunAccount account{};
    groundstate::FrameAccount frames{};
    std::int64_t origin_ns = 0;

    double feature_error = 0;   ///< of the last image, |e| in the image plane at distance 1
    double position_error = 0;  ///< m, of the camera at the end
    double turn_error = 0;      ///< rad
    bool holding = false;       ///< at the end, for want of set-points
    double fastest = 0;         ///< rad/s, what the fastest joint was commanded at the end

    static constexpr double converged_error = 5e-3;

    /// It converged, or came to rest as it must without images or set-points.
    bool as_expected(const LoopSettings& settings) const noexcept {
        const bool must_rest = settings.disturbances.unplugged_s > 0 || settings.hook_fault != HookFault::none;
        return converged() || (holding && must_rest && fastest < 5e-3);
    }

    /// The last goal is reached: features to `converged_error`, the camera to 5 mm and half a degree.
    bool converged() const noexcept {
        return feature_error < converged_error && position_error < 5e-3 && turn_error < 0.5 * M_PI / 180 && !holding &&
               account.ending;
    }
};

/// Blocks: as long as the run takes. Allocates.
Loop run(const LoopSettings& settings);

}  // namespace controller_system
