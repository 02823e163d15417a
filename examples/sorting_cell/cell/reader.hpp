// The reader: what its machine decides.
#pragma once

#include "generated/sorting_cell_machines.hpp"

namespace sorting_cell {

class ReaderHooks final : public ReaderMachine {};

}  // namespace sorting_cell
