// A run as JSON, for reports: what README.md lists. Numbers are written with as many digits as they need to be read back
// the same; a run in virtual time gives the same bytes each time.
#pragma once

#include <cstdio>

#include "closed_loop.hpp"

namespace controller_system {

/// Writes everything that was recorded. False if the file did not take it: errno says why.
bool write_run(std::FILE* file, const LoopSettings& settings, const Loop& loop);

}  // namespace controller_system
