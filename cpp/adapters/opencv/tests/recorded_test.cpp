// Images that nobody here made: the sequences of Debian's visp-images-data, taken by a camera in a laboratory.
#include <gtest/gtest.h>

#include <groundstate/opencv/capture.hpp>
#include <groundstate/opencv/image_sequence.hpp>

#include <fstream>
#include <sstream>

namespace groundstate::opencv {
namespace {

const std::string folder = GROUNDSTATE_RECORDED_IMAGES;
Watchdog watchdog{0};

// The pixels of a PGM file, read without any library.
std::string pixels_of(const std::string& path, int width, int height) {
    std::ifstream file{path, std::ios::binary};
    std::stringstream all;
    all << file.rdbuf();
    const auto size = static_cast<std::size_t>(width * height);
    const std::string bytes = all.str();
    return bytes.substr(bytes.size() - size);
}

TEST(Recorded, ASequenceComesAsItWasTaken) {
    const auto paths = numbered(folder + "/mire-2/image.%04d.pgm", 1, 60);
    Frame<384, 288> frame;
    auto images = ImageSequence::open(paths, {.shape = frame.shape});
    ASSERT_TRUE(images) << images.failure().text;
    for (const std::string& path : paths) {
        ASSERT_TRUE(images->grab(frame.view(), watchdog)) << path;
        const std::string expected = pixels_of(path, 384, 288);
        EXPECT_TRUE(std::equal(expected.begin(), expected.end(), frame.pixels.begin(), frame.pixels.end(),
                               [](char left, std::uint8_t right) { return static_cast<std::uint8_t>(left) == right; }))
            << path;
    }
    EXPECT_EQ(images->grab(frame.view(), watchdog).outcome, Outcome::end_of_stream);
    EXPECT_EQ(images->account().delivered, 60);
}

TEST(Recorded, AnotherSequenceHasAnotherSize) {
    const auto paths = numbered(folder + "/ellipse-1/image.%04d.pgm", 1, 50);
    Frame<365, 256, PixelFormat::rgb8> frame;
    const auto refused = ImageSequence::open(paths, {.shape = Frame<384, 288>::shape});
    EXPECT_EQ(refused.failure().error, OpenError::other_shape);
    EXPECT_NE(refused.failure().text.find("365 x 256"), std::string::npos) << refused.failure().text;
    auto images = ImageSequence::open(paths, {.shape = frame.shape});
    ASSERT_TRUE(images) << images.failure().text;
    Grab got{};
    while ((got = images->grab(frame.view(), watchdog))) {
    }
    EXPECT_EQ(got.outcome, Outcome::end_of_stream);
    EXPECT_EQ(images->account().delivered, 50);
}

TEST(Recorded, AVideoComesFrameByFrame) {
    const std::string path = folder + "/video/cube.mpeg";
    Frame<384, 288> frame;
    auto video = Capture::file(path, {.shape = frame.shape});
    ASSERT_TRUE(video) << video.failure().text;
    Grab got{};
    Grab last{};
    std::vector<double> means;
    while ((got = video->grab(frame.view(), watchdog))) {
        EXPECT_EQ(got.stamp_ns, static_cast<std::int64_t>(got.sequence - 1) * 40'000'000) << "25 a second";
        double sum = 0;
        for (const std::uint8_t pixel : frame.pixels) {
            sum += pixel;
        }
        means.push_back(sum / static_cast<double>(frame.pixels.size()));
        last = got;
    }
    EXPECT_EQ(got.outcome, Outcome::end_of_stream);
    EXPECT_GT(last.sequence, 50u);
    const auto [darkest, brightest] = std::minmax_element(means.begin(), means.end());
    EXPECT_GT(*darkest, 20) << "none is black";
    EXPECT_LT(*brightest, 235);
    EXPECT_GT(*brightest - *darkest, 0.1) << "something moves";
}

}  // namespace
}  // namespace groundstate::opencv
