// What is particular to a run of this robot, as JSON for reports: README.md lists it. A run in virtual time gives the same
// bytes each time.
#pragma once

#include <groundstate/closed_loop/json.hpp>

#include "closed_loop.hpp"

namespace controller_system {

/// Everything that was recorded, as keys of the object that is open.
void write_columns(groundstate::closed_loop::Json& json, const LoopSettings& settings, const Loop& loop);

}  // namespace controller_system
