// Recordings are sources like any other.
#include "rigs.hpp"

namespace groundstate::conformance {

INSTANTIATE_TYPED_TEST_SUITE_P(Images, EverySource, opencv::ImageRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Images, SourceThatEnds, opencv::ImageRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Images, SourceThatIsDamaged, opencv::ImageRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Video, EverySource, opencv::VideoRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Video, SourceThatEnds, opencv::VideoRigs);

}  // namespace groundstate::conformance
