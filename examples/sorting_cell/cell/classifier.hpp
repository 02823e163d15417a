// The classifier: what its machine decides.
#pragma once

#include "generated/sorting_cell_machines.hpp"

namespace sorting_cell {

class ClassifierHooks final : public ClassifierMachine {};

}  // namespace sorting_cell
