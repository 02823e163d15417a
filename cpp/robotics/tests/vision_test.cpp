// Discs found and followed: to parts of a pixel, in noise, covered, gone, and back in their order.
#include <gtest/gtest.h>

#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "groundstate/plant/random.hpp"
#include "groundstate/vision/disc_tracker.hpp"

namespace groundstate::vision {
namespace {

using servo::Pixel;
using servo::Pixels;

constexpr int width = 640;
constexpr int height = 480;

struct Picture {
    cv::Mat grey{height, width, CV_8UC1, cv::Scalar{40}};

    void disc(Pixel centre, double radius, int brightness = 230) {
        const double one = 1 << 8;
        cv::circle(grey, {static_cast<int>(std::lround(centre.u * one)), static_cast<int>(std::lround(centre.v * one))},
                   static_cast<int>(std::lround(radius * one)), cv::Scalar(brightness), cv::FILLED, cv::LINE_AA, 8);
    }
    void discs(const Pixels& centres, double radius) {
        for (const Pixel& centre : centres) {
            disc(centre, radius);
        }
    }
    void noise(double deviation, std::uint64_t seed) {
        plant::Random random{seed};
        for (int v = 0; v < height; ++v) {
            for (int u = 0; u < width; ++u) {
                std::uint8_t& pixel = grey.at<std::uint8_t>(v, u);
                pixel = cv::saturate_cast<std::uint8_t>(pixel + deviation * random.normal());
            }
        }
    }
    ConstFrameView view() const { return {grey.data, {width, height, PixelFormat::mono8}, grey.step}; }
};

constexpr TrackerSettings bright{.discs = {.dark = false}};

double apart(Pixel a, Pixel b) { return std::hypot(a.u - b.u, a.v - b.v); }

Pixels square(Pixel middle, double half) {
    return {{{middle.u - half, middle.v - half},
             {middle.u + half, middle.v - half},
             {middle.u + half, middle.v + half},
             {middle.u - half, middle.v + half}}};
}

TEST(DiscDetector, FindsCentresToPartsOfAPixel) {
    plant::Random random{1};
    for (const double deviation : {0.0, 4.0}) {
        double worst = 0;
        for (int trial = 0; trial < 10; ++trial) {
            const Pixels places = square({320 + 5 * random.normal(), 240 + 5 * random.normal()}, 80);
            Picture picture;
            picture.discs(places, 15);
            picture.noise(deviation, random.bits());
            DiscDetector detector{width, height, bright.discs};
            ASSERT_EQ(detector.search(picture.view()).size(), 4u);
            for (const Pixel& place : places) {
                const auto disc = detector.near(picture.view(), {place.u + 3, place.v - 2}, 26);
                ASSERT_TRUE(disc);
                worst = std::max(worst, apart(disc->centre, place));
                EXPECT_NEAR(disc->area, M_PI * 15 * 15, 60);
                EXPECT_LT(disc->aspect, 1.05);
            }
        }
        EXPECT_LT(worst, 0.1);
    }
}

TEST(DiscDetector, DarkDiscsOnWhite) {
    Picture picture;
    picture.grey = 220;
    for (const Pixel& place : square({200, 300}, 60)) {
        picture.disc(place, 9, 20);
    }
    DiscDetector detector{width, height, {.dark = true}};
    EXPECT_EQ(detector.search(picture.view()).size(), 4u);
}

TEST(DiscDetector, WhatIsNoDiscIsNotFound) {
    Picture picture;
    cv::rectangle(picture.grey, {50, 50, 60, 60}, cv::Scalar{230}, cv::FILLED);    // fills its box
    cv::rectangle(picture.grey, {200, 50, 200, 6}, cv::Scalar{230}, cv::FILLED);   // long
    cv::circle(picture.grey, {300, 300}, 40, cv::Scalar{230}, 3);                  // hollow
    picture.disc({630, 240}, 20);                                                  // cut by the edge
    picture.disc({100, 400}, 2);                                                   // small
    picture.disc({400, 400}, 14);
    DiscDetector detector{width, height, bright.discs};
    const auto& found = detector.search(picture.view());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(apart(found[0].centre, {400, 400}), 0.1);
    EXPECT_FALSE(detector.near(picture.view(), {NAN, 0}, 20));
    EXPECT_FALSE(detector.near(picture.view(), {-1e9, 1e9}, 20));
    EXPECT_FALSE(detector.near(picture.view(), {60, 60}, 5));
}

TEST(DiscDetector, WhatIsBesideADiscDoesNotMatter) {
    Picture picture;
    picture.discs(square({320, 240}, 80), 14);
    DiscDetector detector{width, height, bright.discs};
    ASSERT_EQ(detector.search(picture.view()).size(), 4u);
    const Pixel place{240, 160};
    cv::rectangle(picture.grey, {210, 130, 60, 12}, cv::Scalar{250}, cv::FILLED);  // an edge within reach
    picture.disc({262, 182}, 4);                                                   // and a spot
    const auto disc = detector.near(picture.view(), {238, 163}, 26);
    ASSERT_TRUE(disc);
    EXPECT_LT(apart(disc->centre, place), 0.1);
    cv::rectangle(picture.grey, {236, 140, 8, 20}, cv::Scalar{250}, cv::FILLED);  // that grows together with it
    EXPECT_FALSE(detector.near(picture.view(), {238, 163}, 26));
}

TEST(DiscDetector, LightMayFallUnevenly) {
    Picture picture;
    const Pixels places = square({320, 240}, 80);
    for (int u = 0; u < width; ++u) {
        picture.grey.col(u) = u / 5;  // from 0 to 127
    }
    picture.discs(places, 14);
    DiscDetector detector{width, height, {.dark = false, .level = 180}};
    ASSERT_EQ(detector.search(picture.view()).size(), 4u);
    for (const Pixel& place : places) {
        const auto disc = detector.near(picture.view(), {place.u + 3, place.v - 2}, 26);
        ASSERT_TRUE(disc);
        EXPECT_LT(apart(disc->centre, place), 0.1);
    }
}

TEST(DiscDetector, AnEmptyImageHasNone) {
    Picture picture;
    DiscDetector detector{width, height, bright.discs};
    EXPECT_TRUE(detector.search(picture.view()).empty());
    picture.noise(6, 1);
    EXPECT_TRUE(detector.search(picture.view()).empty());
}

// A target that moves and turns; `draw` may take discs away.
struct Sequence {
    DiscTracker tracker{width, height, bright};
    std::int64_t now_ns = 0;
    Pixels places{};

    template <class Draw>
    const Tracked& next(Pixel middle, double turn, const Draw& draw) {
        places = square({0, 0}, 70);
        for (Pixel& p : places) {
            p = {middle.u + std::cos(turn) * p.u - std::sin(turn) * p.v, middle.v + std::sin(turn) * p.u + std::cos(turn) * p.v};
        }
        Picture picture;
        draw(picture, places);
        picture.noise(3, static_cast<std::uint64_t>(now_ns));
        now_ns += 10'000'000;
        return tracker.look(picture.view(), now_ns);
    }
    void expect_followed(double tolerance) const {
        for (std::size_t i = 0; i < servo::points; ++i) {
            EXPECT_LT(apart(tracker.present().pixels[i], places[i]), tolerance) << "disc " << i;
        }
    }
};

const auto all = [](Picture& picture, const Pixels& places) { picture.discs(places, 13); };
const auto all_but = [](std::size_t hidden) {
    return [hidden](Picture& picture, const Pixels& places) {
        for (std::size_t i = 0; i < servo::points; ++i) {
            if (i != hidden) {
                picture.disc(places[i], 13);
            }
        }
    };
};

TEST(DiscTracker, KeepsTheOrderThroughATurn) {
    Sequence sequence;
    for (int i = 0; i < 300; ++i) {
        const Tracked& seen = sequence.next({320 + 60 * std::sin(0.03 * i), 240}, 0.012 * i, all);
        ASSERT_EQ(seen.track, Track::tracking) << i;
        sequence.expect_followed(0.2);
    }
    EXPECT_EQ(sequence.tracker.searches(), 1);
}

TEST(DiscTracker, NumbersAsExpected) {
    for (std::size_t first = 0; first < 4; ++first) {
        Sequence sequence;
        Pixels expected = square({320, 240}, 90);
        std::rotate(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(first), expected.end());
        sequence.tracker.expect(expected);
        const Tracked& seen = sequence.next({300, 250}, 0.3, all);
        ASSERT_TRUE(seen);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_LT(apart(seen.pixels[i], sequence.places[(i + first) % 4]), 0.2);
        }
    }
}

TEST(DiscTracker, PredictsACoveredDiscAndFindsItAgain) {
    Sequence sequence;
    for (int i = 0; i < 40; ++i) {
        const bool covered = i >= 20 && i < 28;
        const Tracked& seen = covered ? sequence.next({320.0 + 2 * i, 240.0 + i}, 0.01 * i, all_but(2))
                                      : sequence.next({320.0 + 2 * i, 240.0 + i}, 0.01 * i, all);
        ASSERT_EQ(seen.track, covered ? Track::predicting : Track::tracking) << i;
        EXPECT_EQ(seen.measured[2], !covered);
        EXPECT_EQ(seen.predicted_images, covered ? i - 19 : 0);
        sequence.expect_followed(0.5);
    }
    EXPECT_EQ(sequence.tracker.searches(), 1);
}

TEST(DiscTracker, ADiscCoveredInPartIsNotBelieved) {
    Sequence sequence;
    (void)sequence.next({320, 240}, 0, all);
    const Tracked& seen = sequence.next({321, 240}, 0, [](Picture& picture, const Pixels& places) {
        picture.discs(places, 13);
        cv::rectangle(picture.grey, cv::Rect(static_cast<int>(places[1].u), static_cast<int>(places[1].v) - 20, 30, 40),
                      cv::Scalar{40}, cv::FILLED);
    });
    EXPECT_EQ(seen.track, Track::predicting);
    EXPECT_FALSE(seen.measured[1]);
    sequence.expect_followed(0.5);
}

TEST(DiscTracker, GivesUpAfterTheStatedImagesAndSearches) {
    Sequence sequence;
    (void)sequence.next({320, 240}, 0, all);
    for (int i = 0; i < bright.most_predicted; ++i) {
        ASSERT_EQ(sequence.next({320, 240}, 0, all_but(0)).track, Track::predicting);
    }
    EXPECT_FALSE(sequence.next({320, 240}, 0, all_but(0)));
    EXPECT_FALSE(sequence.next({320, 240}, 0, [](Picture&, const Pixels&) {}));
    EXPECT_TRUE(sequence.next({330, 250}, 0.2, all));
    sequence.expect_followed(0.2);
}

TEST(DiscTracker, ChoosesAmongMoreThanFour) {
    Sequence sequence;
    sequence.tracker.expect(square({320, 240}, 70));
    const Tracked& seen = sequence.next({325, 245}, 0.1, [](Picture& picture, const Pixels& places) {
        picture.discs(places, 13);
        picture.disc({60, 60}, 13);
        picture.disc({600, 420}, 12);
        picture.disc({320, 240}, 5);
    });
    ASSERT_TRUE(seen);
    sequence.expect_followed(0.2);
}

}  // namespace
}  // namespace groundstate::vision
