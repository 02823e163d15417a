// That grabbing allocates nothing after the first frames, or, where an adapter's library does, that it frees it again.
//
// For programs without sanitizers, which bring their own allocator: link allocations.cpp, which counts every call of
// malloc and its kin, those of the libraries as well. A Rig says `static constexpr bool allocates`.
#pragma once

#include "frame_source_suite.hpp"

namespace groundstate::conformance {

/// Since the program began. Who: everybody.
std::int64_t allocations() noexcept;
std::int64_t releases() noexcept;

template <class Rig>
class GrabMemory : public Sitting<Rig> {};
TYPED_TEST_SUITE_P(GrabMemory);

TYPED_TEST_P(GrabMemory, IsNotAllocatedAfterTheFirstFrames) {
    this->open({.frames = 60});
    for (int i = 0; i < 10; ++i) {
        (void)this->grab();
        this->rig.pass();
    }
    std::int64_t allocated = 0;
    std::int64_t kept = 0;
    std::int64_t frames = 0;
    for (int i = 0; i < 40; ++i) {
        Watchdog watchdog{ample_budget_ns};
        const std::int64_t allocated_before = allocations();
        const std::int64_t released_before = releases();
        const Grab grab = (*this->source)->grab(this->canvas->view(), watchdog);
        allocated += allocations() - allocated_before;
        kept += allocations() - allocated_before - (releases() - released_before);
        frames += bool(grab);
        this->rig.pass();
    }
    EXPECT_GT(frames, 20);
    if (TypeParam::allocates) {
        EXPECT_LE(kept, 0) << "what is allocated is freed within the same grab";
    } else {
        EXPECT_EQ(allocated, 0);
    }
    EXPECT_GT(allocations(), 0) << "they are counted";
}

REGISTER_TYPED_TEST_SUITE_P(GrabMemory, IsNotAllocatedAfterTheFirstFrames);

}  // namespace groundstate::conformance
