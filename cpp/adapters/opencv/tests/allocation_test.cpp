// What recordings ask of the allocator: OpenCV's decoders do, and free it.
#include "../../conformance/allocation_suite.hpp"
#include "rigs.hpp"

namespace groundstate::conformance {

INSTANTIATE_TYPED_TEST_SUITE_P(Images, GrabMemory, opencv::ImageRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Video, GrabMemory, opencv::VideoRigs);

}  // namespace groundstate::conformance
