// The simulated camera is a source like any other.
#include "rig.hpp"

namespace groundstate::conformance {

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, EverySource, simulated::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, SourceThatEnds, simulated::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, SourceThatUnplugs, simulated::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, SourceThatWaits, simulated::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, SourceThatLoses, simulated::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, SourceThatIsDamaged, simulated::Rigs);

}  // namespace groundstate::conformance
