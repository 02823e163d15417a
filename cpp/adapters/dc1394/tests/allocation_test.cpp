// What a FireWire camera asks of the allocator.
#include "../../conformance/allocation_suite.hpp"
#include "rig.hpp"

namespace groundstate::conformance {

INSTANTIATE_TYPED_TEST_SUITE_P(Dc1394, GrabMemory, dc1394::Rigs);

}  // namespace groundstate::conformance
