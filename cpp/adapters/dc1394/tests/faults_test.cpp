// What goes wrong with a FireWire camera, and what is then said; each with the stand-in, of which nothing is kept.
#include <gtest/gtest.h>

#include <groundstate/dc1394/camera.hpp>

#include "standin/standin.hpp"

namespace groundstate::dc1394 {
namespace {

class Faults : public testing::Test {
  protected:
    Faults() { standin::begin(); }
    ~Faults() override {
        opened.reset();
        EXPECT_EQ(standin::world().handed_out, 0) << "all was given back";
        for (const char* refusal : standin::world().refusals) {
            ADD_FAILURE() << refusal;
        }
    }

    void open(const Settings& settings = {}) {
        opened.emplace(Camera::open(settings));
        ASSERT_TRUE(*opened) << opened->failure().text;
    }

    Grab grab(std::int64_t budget_ns = 0) {
        Watchdog watchdog{budget_ns};
        return (*opened)->grab(frame.view(), watchdog);
    }

    void take(int frames) {
        for (int i = 0; i < frames; ++i) {
            standin::take();
        }
    }

    // Grabs until there is something else to be said than that there is no frame.
    Grab grab_patiently() {
        Grab got{};
        for (int times = 0; times < 10'000 && got.outcome == Outcome::timeout; ++times) {
            got = grab(1'000'000);
        }
        return got;
    }

    void expect_refused(const Settings& settings, OpenError error, const std::string& word) {
        const auto refused = Camera::open(settings);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.failure().error, error) << text(refused.failure().error);
        EXPECT_NE(refused.failure().text.find(word), std::string::npos) << refused.failure().text;
    }

    std::optional<Opened<Camera>> opened{};
    Frame<640, 480> frame{};
};

TEST_F(Faults, NoBus) {
    standin::world().bus = false;
    expect_refused({}, OpenError::not_found, "no IEEE 1394 bus");
    EXPECT_FALSE(enumerate().failure.text.empty());
}

TEST_F(Faults, NoCamera) {
    standin::world().cameras = 0;
    expect_refused({}, OpenError::not_found, "no camera");
    EXPECT_TRUE(enumerate().failure.text.empty());
    EXPECT_TRUE(enumerate().cameras.empty());
}

TEST_F(Faults, AnotherCameraThanTheOneNamed) {
    expect_refused({.guid = 42}, OpenError::not_found, "identifier");
    standin::world().cameras = 2;
    open({.guid = standin::guid + 1});
    opened.reset();
    const Enumeration found = enumerate();
    ASSERT_EQ(found.cameras.size(), 2u);
    EXPECT_EQ(found.cameras[1].guid, standin::guid + 1);
    EXPECT_EQ(found.cameras[1].name, "Standin Camera");
}

TEST_F(Faults, AModeRateOrRingThatItDoesNotHave) {
    expect_refused({.shape = {320, 240}}, OpenError::refused, "640 x 480 MONO8");
    expect_refused({.frames_per_second = 60}, OpenError::refused, "it takes 15");
    expect_refused({.dma_buffers = 1}, OpenError::refused, "DMA");
    expect_refused({.dma_buffers = 1'000}, OpenError::no_resources, "DMA");
    standin::world().modes.clear();
    expect_refused({}, OpenError::refused, "no other of a fixed size");
}

TEST_F(Faults, EveryCallThatFailsLeavesNothingBehind) {
    const Settings settings{.speed = IsoSpeed::s800};
    int calls = 1;
    for (;; ++calls) {
        standin::begin();
        standin::world().failing_call = calls;
        standin::world().error = calls % 2 == 0 ? DC1394_NO_BANDWIDTH : DC1394_INVALID_VIDEO_MODE;
        const auto camera = Camera::open(settings);
        if (camera) {
            break;
        }
        EXPECT_FALSE(camera.failure().text.empty());
        EXPECT_EQ(standin::world().handed_out, 0) << "after call " << calls;
        EXPECT_TRUE(standin::world().refusals.empty()) << standin::world().refusals.front();
    }
    EXPECT_EQ(calls, 12) << "there are eleven calls that can fail";
}

TEST_F(Faults, WhatFailedIsSaidInTheLibrarysWords) {
    for (const auto& [error, meaning, word] :
         {std::tuple{DC1394_NO_BANDWIDTH, OpenError::no_resources, "No bandwidth"},
          std::tuple{DC1394_INVALID_VIDEO_MODE, OpenError::refused, "Invalid video mode"},
          std::tuple{DC1394_FAILURE, OpenError::driver, "Generic failure"}}) {
        standin::begin();
        standin::world().failing_call = 9;
        standin::world().error = error;
        expect_refused({}, meaning, word);
    }
}

TEST_F(Faults, UnpluggedInMidRunWithFramesInTheRing) {
    open();
    take(2);
    standin::unplug();
    EXPECT_EQ(grab().sequence, 2u) << "what was taken before";
    for (int times = 0; times < 3; ++times) {
        EXPECT_EQ(grab(1'000'000).outcome, Outcome::disconnected);
    }
    EXPECT_EQ((*opened)->account().delivered, 1);
}

TEST_F(Faults, UnpluggedWithoutAWordIsFoundOutByAsking) {
    open();
    take(1);
    EXPECT_TRUE(grab());
    standin::unplug(false);
    EXPECT_EQ(grab_patiently().outcome, Outcome::disconnected);
    EXPECT_EQ(grab().outcome, Outcome::disconnected);
    EXPECT_GT((*opened)->account().timeouts, 0) << "it was not said at once";
}

TEST_F(Faults, AfterABusResetTheCameraIsToldToSendAgain) {
    open();
    take(1);
    EXPECT_TRUE(grab());
    standin::reset_bus();
    Grab got{};
    for (int times = 0; times < 10'000 && !got; ++times) {
        standin::take();  // which it does not until it is told
        got = grab(1'000'000);
        ASSERT_NE(got.outcome, Outcome::disconnected);
    }
    EXPECT_TRUE(got);
    EXPECT_EQ((*opened)->troubles().restarts, 1);
}

TEST_F(Faults, ACorruptFrameIsSaidAndTheNextOneIsGood) {
    open();
    standin::take({.corrupt = true});
    EXPECT_EQ(grab().outcome, Outcome::damaged);
    standin::take({.short_data = true});
    EXPECT_EQ(grab().outcome, Outcome::damaged);
    take(1);
    const Grab good = grab();
    EXPECT_EQ(good.sequence, 3u);
    EXPECT_EQ(good.lost, 2u);
    EXPECT_EQ(frame.pixels[5], standin::pixel(3, 5, 0, 0));
}

TEST_F(Faults, AFrameOfAnotherSizeIsNotTaken) {
    open();
    frame.pixels.fill(77);
    standin::take({.other_size = true});
    EXPECT_EQ(grab().outcome, Outcome::other_shape);
    EXPECT_TRUE(std::all_of(frame.pixels.begin(), frame.pixels.end(), [](auto pixel) { return pixel == 77; }));
    take(1);
    EXPECT_EQ(grab().lost, 1u);
}

TEST_F(Faults, AFullRingLosesFramesThatAreCounted) {
    open({.dma_buffers = 4});
    take(10);
    EXPECT_EQ(grab().sequence, 4u) << "the newest that found a place";
    EXPECT_EQ((*opened)->troubles().full_rings, 1);
    take(1);
    const Grab next = grab();
    EXPECT_EQ(next.sequence, 11u);
    EXPECT_EQ(next.lost, 6u);
    EXPECT_EQ((*opened)->account().lost, 9);
    EXPECT_EQ((*opened)->troubles().full_rings, 1);
}

TEST_F(Faults, TheNewestOfTheRingIsGiven) {
    open();
    take(3);
    const Grab got = grab();
    EXPECT_EQ(got.sequence, 3u);
    EXPECT_EQ(got.lost, 2u);
    EXPECT_EQ(frame.pixels[0], standin::pixel(3, 0, 0, 0));
    EXPECT_EQ(grab().outcome, Outcome::timeout);
    EXPECT_EQ(standin::world().handed_out, 3) << "context, camera and ring, and no frame";
}

TEST_F(Faults, StampsAreThoseOfTheDriver) {
    open();
    take(1);
    const Grab first = grab();
    take(1);
    const Grab second = grab();
    EXPECT_NEAR(static_cast<double>(second.stamp_ns - first.stamp_ns), 1e3 * standin::frame_us, 1e6);
    EXPECT_LT(second.stamp_ns, MonotonicClock{}.now_ns() - 1'000'000'000) << "when it was taken, not fetched";
    standin::take({.no_stamp = true});
    const Grab third = grab();
    EXPECT_TRUE(third) << "a stamp that is none is not believed";
    EXPECT_GT(third.stamp_ns, second.stamp_ns);
}

TEST_F(Faults, BrightnessIsTakenOutOfColour) {
    standin::world().modes = {DC1394_VIDEO_MODE_640x480_YUV422};
    open();
    take(1);
    ASSERT_TRUE(grab());
    for (std::uint32_t x = 0; x < 640; ++x) {
        ASSERT_EQ(frame.view().row(100)[x], standin::pixel(1, x, 100, 0));
    }
}

TEST_F(Faults, ColoursKeepTheirOrder) {
    for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::bgr8}) {
        open({.shape = {640, 480, format}});
        Frame<640, 480, PixelFormat::rgb8> colour;
        FrameView view = colour.view();
        view.shape.format = format;
        take(1);
        Watchdog watchdog{0};
        const Grab got = (*opened)->grab(view, watchdog);
        ASSERT_TRUE(got);
        const bool swapped = format == PixelFormat::bgr8;
        EXPECT_EQ(view.row(7)[30], standin::pixel(1 + swapped, 10, 7, swapped ? 2 : 0));
        EXPECT_EQ(view.row(7)[31], standin::pixel(1 + swapped, 10, 7, 1));
        EXPECT_EQ(view.row(7)[32], standin::pixel(1 + swapped, 10, 7, swapped ? 0 : 2));
        opened.reset();
    }
}

}  // namespace
}  // namespace groundstate::dc1394
