// A FireWire camera is a source like any other.
#include "rig.hpp"

namespace groundstate::conformance {

INSTANTIATE_TYPED_TEST_SUITE_P(Dc1394, EverySource, dc1394::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Dc1394, SourceThatUnplugs, dc1394::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Dc1394, SourceThatWaits, dc1394::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Dc1394, SourceThatLoses, dc1394::Rigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Dc1394, SourceThatIsDamaged, dc1394::Rigs);

}  // namespace groundstate::conformance
