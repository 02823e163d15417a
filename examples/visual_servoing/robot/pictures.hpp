// The images that were kept, with what was made of them drawn in: the discs as tracked, the way that they have come in the
// image, and where they are to be.
#pragma once

#include <string>

#include "closed_loop.hpp"

namespace controller_system {

/// Writes FOLDER/view-1.png and so on. How many were written; fewer than were kept if the folder does not take them.
std::size_t write_pictures(const std::string& folder, const Loop& loop);

}  // namespace controller_system
