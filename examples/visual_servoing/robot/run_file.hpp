// What is particular to a run of this robot, as JSON for reports: spec/run.md lists it. A run in virtual time gives the same
// bytes each time.
#pragma once

#include <groundstate/closed_loop/json.hpp>

#include "closed_loop.hpp"

namespace controller_system {

/// Where the run came to, in a sentence.
std::string ending(const Loop& loop);

/// Everything that was recorded, as keys of the object that is open. `views` is the folder of write_pictures, from the folder
/// of the JSON; empty: there are none.
void write_columns(groundstate::closed_loop::Json& json, const LoopSettings& settings, const Loop& loop,
                   const std::string& views);

}  // namespace controller_system
