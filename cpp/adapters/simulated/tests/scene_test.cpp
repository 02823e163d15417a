// Pictures of discs: where they are, how large, what is seen from where, and what the lens makes of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rig.hpp"

namespace groundstate::simulated {
namespace {

constexpr std::uint8_t background = 40;

template <PixelFormat Format = PixelFormat::mono8>
using Picture = Frame<640, 480, Format>;

// The weight of what is brighter than the background, within a box, and its centre.
struct Blob {
    double weight = 0;
    double x = 0;
    double y = 0;
};

Blob blob_in(const ConstFrameView& picture, const Box& box) {
    Blob blob;
    for (int y = box.top; y < box.top + box.height; ++y) {
        for (int x = box.left; x < box.left + box.width; ++x) {
            const double weight = std::max(0, picture.row(y)[x] - background);
            blob.weight += weight;
            blob.x += weight * x;
            blob.y += weight * y;
        }
    }
    return {blob.weight, blob.x / blob.weight, blob.y / blob.weight};
}

Pose turned_about_y(double angle, const Vector& position) {
    return {{std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)}, position};
}

TEST(Scene, ProjectsAsAPinholeDoes) {
    Scene scene{{}, {.fx = 500, .fy = 400, .cx = 320, .cy = 240}};
    const auto pixel = scene.project({0.1, -0.2, 2}, {});
    ASSERT_TRUE(pixel);
    EXPECT_DOUBLE_EQ(pixel->x, 320 + 500 * 0.05);
    EXPECT_DOUBLE_EQ(pixel->y, 240 - 400 * 0.1);
    EXPECT_FALSE(scene.project({0, 0, -1}, {})) << "behind the camera";
    EXPECT_FALSE(scene.project({0, 0, std::nan("")}, {}));
    const auto turned = scene.project({1, 0, 0}, turned_about_y(std::numbers::pi / 2, {}));
    ASSERT_TRUE(turned);
    EXPECT_NEAR(turned->x, 320, 1e-9) << "ahead of a camera that looks along x";
}

TEST(Scene, DrawsDiscsWhereTheyAreWithinAHundredthOfAPixel) {
    Picture<> picture;
    for (int i = 0; i < 50; ++i) {
        const double shift = 0.0007 * i;
        Scene scene{{{.centre = {0.1 + shift, -0.05 - shift, 1}, .radius = 0.03}}, {}, background};
        scene.draw({}, picture.view());
        const Blob blob = blob_in(picture.view(), {0, 0, 640, 480});
        const auto centre = scene.project(scene.discs()[0].centre, {});
        EXPECT_NEAR(blob.x, centre->x, 0.01);
        EXPECT_NEAR(blob.y, centre->y, 0.01);
    }
}

TEST(Scene, DrawsDiscsAsLargeAsTheyAre) {
    Picture<> picture;
    Scene scene{{{.centre = {0, 0, 1}, .radius = 0.05}}, {}, background};
    scene.draw({}, picture.view());
    const double radius =
        std::sqrt(blob_in(picture.view(), {0, 0, 640, 480}).weight / (230 - background) / std::numbers::pi);
    EXPECT_NEAR(radius, 30, 0.01);
    // Seen obliquely it is an ellipse, as wide as the cosine says.
    const Pose oblique = turned_about_y(std::numbers::pi / 3, {-std::sin(std::numbers::pi / 3), 0, 0.5});
    const Box box = scene.bounds(0, oblique, picture.shape);
    EXPECT_NEAR(static_cast<double>(box.width) / box.height, 0.5, 0.05);
}

TEST(Scene, SeesNothingBehindOrBesideTheCamera) {
    Picture<> picture;
    Picture<> empty;
    Scene{{}, {}, background}.draw({}, empty.view());
    const double nan = std::nan("");
    for (const Vector& centre : {Vector{0, 0, -1}, Vector{5, 0, 1}, Vector{0, 0, 0}, Vector{1e9, 1e9, 1e-2},
                                 Vector{nan, 0, 1}, Vector{0, 0, INFINITY}}) {
        Scene scene{{{.centre = centre}}, {}, background};
        scene.draw({}, picture.view());
        EXPECT_EQ(picture.pixels, empty.pixels);
        EXPECT_EQ(scene.bounds(0, {}, picture.shape).width, 0);
    }
    const Pose nowhere{{nan, nan, nan, nan, nan, nan, nan, nan, nan}, {nan, nan, nan}};
    four_discs().draw(nowhere, picture.view());
    EXPECT_EQ(picture.pixels, empty.pixels);
}

TEST(Scene, CutsWhatReachesOverTheEdge) {
    Picture<> picture;
    Scene scene{{{.centre = {-319.5 / 600, 0, 1}, .radius = 0.05}}, {}, background};
    scene.draw({}, picture.view());
    const Blob half = blob_in(picture.view(), {0, 0, 640, 480});
    EXPECT_NEAR(half.weight / (230 - background), std::numbers::pi * 30 * 30 / 2 + 30, 5);
}

TEST(Scene, DrawsColourAsItDrawsGrey) {
    Picture<> grey;
    Picture<PixelFormat::bgr8> colour;
    four_discs().draw({}, grey.view());
    four_discs().draw({}, colour.view());
    for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
        ASSERT_TRUE(std::all_of(&colour.pixels[3 * i], &colour.pixels[3 * i] + 3,
                                [&](std::uint8_t byte) { return byte == grey.pixels[i]; }));
    }
}

TEST(Lens, CoversOneDiscForSomeFrames) {
    Scene scene = four_discs();
    const Faults faults{.occluded = 0.05, .occluded_frames = 4};
    const Lens lens{faults, {640, 480}};
    Picture<> picture;
    int covered_frames = 0;
    for (std::uint64_t frame = 1; frame <= 100; ++frame) {
        scene.draw({}, picture.view());
        lens.spoil(frame, scene, {}, picture.view());
        const std::size_t covered = lens.covered(frame, 4);
        covered_frames += covered < 4;
        for (std::size_t disc = 0; disc < 4; ++disc) {
            const double weight = blob_in(picture.view(), scene.bounds(disc, {}, picture.shape)).weight;
            EXPECT_EQ(weight > 0, disc != covered) << "frame " << frame << " disc " << disc;
        }
    }
    EXPECT_GT(covered_frames, 4);
    EXPECT_LT(covered_frames, 60);
}

TEST(Lens, BlurKeepsWeightAndPlace) {
    Scene scene = four_discs();
    const Lens lens{{.blur = 1.5}, {640, 480}};
    Picture<> sharp;
    Picture<> blurred;
    scene.draw({}, sharp.view());
    scene.draw({}, blurred.view());
    lens.spoil(1, scene, {}, blurred.view());
    EXPECT_NE(sharp.pixels, blurred.pixels);
    for (const Box& quarter :
         {Box{0, 0, 320, 240}, Box{320, 0, 320, 240}, Box{0, 240, 320, 240}, Box{320, 240, 320, 240}}) {
        const Blob before = blob_in(sharp.view(), quarter);
        const Blob after = blob_in(blurred.view(), quarter);
        EXPECT_NEAR(after.weight / before.weight, 1, 0.01);
        EXPECT_NEAR(after.x, before.x, 0.02);
        EXPECT_NEAR(after.y, before.y, 0.02);
    }
}

TEST(Lens, BlursNearDiscsOnce) {
    Scene apart{{{.centre = {-0.1, 0, 1}}, {.centre = {0.1, 0, 1}}}, {}};
    Scene together{{{.centre = {-0.1, 0, 1}}, {.centre = {0.1, 0, 1}}, {.centre = {0.103, 0, 1}}}, {}};
    const Lens lens{{.blur = 1}, {640, 480}};
    Picture<> one;
    Picture<> other;
    apart.draw({}, one.view());
    lens.spoil(1, apart, {}, one.view());
    together.draw({}, other.view());
    lens.spoil(1, together, {}, other.view());
    for (int y = 0; y < 480; ++y) {
        ASSERT_TRUE(std::equal(one.view().row(y), one.view().row(y) + 300, other.view().row(y),
                               [](int left, int right) { return std::abs(left - right) <= 1; }))
            << "row " << y;
    }
}

TEST(Lens, NoiseHasTheDeviationAskedForAndIsNewInEachFrame) {
    Scene empty{{}, {}, 100};
    const Lens lens{{.noise = 4}, {640, 480}};
    Picture<> first;
    Picture<> second;
    for (auto* picture : {&first, &second}) {
        empty.draw({}, picture->view());
        lens.spoil(picture == &first ? 1 : 2, empty, {}, picture->view());
        double sum = 0;
        double squares = 0;
        for (const std::uint8_t pixel : picture->pixels) {
            sum += pixel - 100.0;
            squares += (pixel - 100.0) * (pixel - 100.0);
        }
        const double count = static_cast<double>(picture->pixels.size());
        EXPECT_NEAR(sum / count, 0, 0.1);
        EXPECT_NEAR(std::sqrt(squares / count), 4, 0.2);
    }
    EXPECT_NE(first.pixels, second.pixels);
}

}  // namespace
}  // namespace groundstate::simulated
