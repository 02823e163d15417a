// A camera of the machine, through OpenCV's own driver for Video4Linux, with a stand-in below it.
#include "../../conformance/frame_source_suite.hpp"

#include <groundstate/clock.hpp>
#include <groundstate/opencv/capture.hpp>

#include "v4l2_standin.hpp"

namespace groundstate::opencv {

struct DeviceRig {
    using Source = Capture;

    Opened<Source> open(const conformance::Script& the_script) {
        script = the_script;
        frame = 0;
        v4l2_standin::begin();
        auto camera = Source::device(v4l2_standin::index);
        if (!script.late) {
            pass();
        }
        return camera;
    }

    // One frame that can be fetched, with some before it that cannot; after the last one the cable is pulled.
    void pass() {
        for (bool fetched = false; !fetched;) {
            if (frame == script.frames) {
                v4l2_standin::unplug();
                return;
            }
            ++frame;
            const bool lost = script.loses && frame % 5 < 2;
            v4l2_standin::take(lost);
            fetched = !lost;
        }
    }

    conformance::Script script{};
    std::uint64_t frame = 0;
};

namespace {

class Device : public testing::Test {
  protected:
    Device() { v4l2_standin::begin(); }

    Grab grab(Capture& camera) {
        Watchdog watchdog{1'000'000};
        return camera.grab(frame.view(), watchdog);
    }

    Frame<640, 480, PixelFormat::bgr8> frame{};
};

TEST_F(Device, GivesTheNewestFrameOfTheDriver) {
    auto camera = Capture::device(v4l2_standin::index);
    ASSERT_TRUE(camera) << camera.failure().text;
    for (int i = 0; i < 3; ++i) {
        v4l2_standin::take();
    }
    const Grab got = grab(*camera);
    EXPECT_EQ(got.sequence, 3u);
    EXPECT_EQ(got.lost, 2u);
    for (std::uint32_t at = 0; at < frame.pixels.size(); at += 997) {
        ASSERT_EQ(frame.pixels[at], v4l2_standin::pixel(v4l2_standin::taken(), at));
    }
    EXPECT_EQ(grab(*camera).outcome, Outcome::timeout);
}

TEST_F(Device, StampsAreThoseOfTheDriver) {
    auto camera = Capture::device(v4l2_standin::index);
    v4l2_standin::take();
    const Grab first = grab(*camera);
    v4l2_standin::take();
    const Grab second = grab(*camera);
    EXPECT_NEAR(static_cast<double>(second.stamp_ns - first.stamp_ns), 1e3 * v4l2_standin::frame_us, 2e3);
    EXPECT_LT(second.stamp_ns, MonotonicClock{}.now_ns() - 1'000'000'000) << "when it was taken, not fetched";
}

TEST_F(Device, AFullRingLosesFramesThatAreCounted) {
    auto camera = Capture::device(v4l2_standin::index);
    v4l2_standin::take();
    EXPECT_EQ(grab(*camera).sequence, 1u);
    for (int i = 0; i < 9; ++i) {
        v4l2_standin::take();
    }
    const Grab got = grab(*camera);
    ASSERT_TRUE(got);
    EXPECT_LT(got.sequence, 10u) << "the newest that found a buffer";
    v4l2_standin::take();
    const Grab next = grab(*camera);
    EXPECT_EQ(next.sequence, 11u);
    EXPECT_EQ(next.lost, 10 - got.sequence);
    EXPECT_EQ(camera->account().lost, 8);
}

TEST_F(Device, WhatCannotBeOpenedIsToldAndWhy) {
    const auto other = Capture::device(v4l2_standin::index, {.shape = {320, 240, PixelFormat::bgr8}});
    ASSERT_FALSE(other);
    EXPECT_EQ(other.failure().error, OpenError::other_shape);
    EXPECT_NE(other.failure().text.find("640 x 480"), std::string::npos) << other.failure().text;
    v4l2_standin::occupy();
    EXPECT_EQ(Capture::device(v4l2_standin::index).failure().error, OpenError::busy);
    v4l2_standin::begin();
    v4l2_standin::break_down();
    const auto broken = Capture::device(v4l2_standin::index);
    EXPECT_EQ(broken.failure().error, OpenError::driver);
    EXPECT_NE(broken.failure().text.find("sends nothing"), std::string::npos) << broken.failure().text;
    v4l2_standin::begin();
    v4l2_standin::unplug();
    EXPECT_EQ(Capture::device(v4l2_standin::index).failure().error, OpenError::not_found);
}

}  // namespace
}  // namespace groundstate::opencv

namespace groundstate::conformance {

using DeviceRigs = testing::Types<opencv::DeviceRig>;
INSTANTIATE_TYPED_TEST_SUITE_P(Device, EverySource, DeviceRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Device, SourceThatUnplugs, DeviceRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Device, SourceThatWaits, DeviceRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Device, SourceThatLoses, DeviceRigs);

}  // namespace groundstate::conformance
