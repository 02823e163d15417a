// Four dots found and followed in images that nobody here made: a sequence of Debian's visp-images-data, in which a hand
// moves a board with four dots and a bright ellipse between them, before a wall of pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include <groundstate/opencv/image_sequence.hpp>

#include "groundstate/vision/disc_tracker.hpp"

namespace groundstate::vision {
namespace {

using servo::Pixel;
using servo::Pixels;

using Image = Frame<384, 288>;
constexpr int images = 501;

double apart(Pixel a, Pixel b) { return std::hypot(a.u - b.u, a.v - b.v); }

// Where the diagonals meet: the middle of the board, however it is seen.
Pixel middle(const Pixels& p) {
    const Pixel along{p[2].u - p[0].u, p[2].v - p[0].v};
    const Pixel across{p[3].u - p[1].u, p[3].v - p[1].v};
    const double share = ((p[1].u - p[0].u) * across.v - (p[1].v - p[0].v) * across.u) /
                         (along.u * across.v - along.v * across.u);
    return {p[0].u + share * along.u, p[0].v + share * along.v};
}

Pixel between(Pixel a, Pixel b, double share) { return {a.u + share * (b.u - a.u), a.v + share * (b.v - a.v)}; }

int grey(const Image& image, Pixel at) {
    return image.view().row(static_cast<int>(std::lround(at.v)))[std::lround(at.u)];
}

// Where the dots are seen in some of the images, read off them by eye.
const std::map<std::uint64_t, Pixels> by_eye = {
    {1, {{{86, 180}, {217, 168}, {243, 249}, {93, 267}}}},
    {165, {{{104, 134}, {235, 139}, {262, 217}, {111, 216}}}},
    {222, {{{88, 126}, {236, 121}, {267, 178}, {85, 188}}}},
    {300, {{{80, 119}, {232, 103}, {253, 172}, {67, 192}}}},
};

TEST(Recorded, FourDotsAreFollowedThroughTheSequence) {
    Watchdog watchdog{0};
    Image image;
    auto source = opencv::ImageSequence::open(
        opencv::numbered(GROUNDSTATE_RECORDED_IMAGES "/mire-2/image.%04d.pgm", 1, images), {.shape = image.shape});
    ASSERT_TRUE(source) << source.failure().text;

    DiscTracker tracker{384, 288, {.discs = {.dark = false, .most_area = 1'000, .most_aspect = 4}}};
    tracker.expect(by_eye.at(1));
    int whole = 0;
    while (const Grab got = source->grab(image.view(), watchdog)) {
        const Tracked& now = tracker.look(image.view(), got.stamp_ns);
        ASSERT_TRUE(now) << "image " << got.sequence;
        if (const auto seen = by_eye.find(got.sequence); seen != by_eye.end()) {
            for (std::size_t i = 0; i < servo::points; ++i) {
                EXPECT_LT(apart(now.pixels[i], seen->second[i]), 2.5) << "image " << got.sequence << ", dot " << i;
            }
        }
        if (now.track != Track::tracking) {
            continue;
        }
        ++whole;
        // The ellipse is where the diagonals meet, and the board is dark between it and the dots.
        const Pixel centre = middle(now.pixels);
        EXPECT_GT(grey(image, centre), 240) << "image " << got.sequence;
        for (const Pixel& dot : now.pixels) {
            EXPECT_GT(grey(image, dot), 240) << "image " << got.sequence;
            EXPECT_LT(grey(image, between(centre, dot, 0.75)), 180) << "image " << got.sequence;
        }
    }
    EXPECT_EQ(source->account().delivered, images);
    EXPECT_EQ(tracker.searches(), 1) << "never lost";
    EXPECT_GE(whole, images - 10) << "a dot is hardly ever predicted";
}

}  // namespace
}  // namespace groundstate::vision
