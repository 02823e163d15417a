// Made from ControllerSystem.chart by `groundstate generate cpp`; do not edit. What channels and devices carry.
#pragma once

#include <cstdint>

namespace controller_system {

enum class ArmMode : std::uint32_t { STANDING, FOLLOWING, STOPPING };

enum class ServoMode : std::uint32_t { WITHOUT_TARGET, SEARCHING, TRACKING, CONVERGED, COVERED, LOST };

}  // namespace controller_system
