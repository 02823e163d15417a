// What the simulated camera asks of the allocator.
#include "../../conformance/allocation_suite.hpp"
#include "rig.hpp"

namespace groundstate::conformance {

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, GrabMemory, simulated::Rigs);

}  // namespace groundstate::conformance
