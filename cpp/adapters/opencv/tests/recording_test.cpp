// What is in a recording comes out of it; and what is wrong with one is told.
#include <gtest/gtest.h>

#include "rigs.hpp"

namespace groundstate::opencv {
namespace {

Watchdog watchdog{0};

template <PixelFormat Format>
using Picture = Frame<160, 120, Format>;

template <PixelFormat Format>
cv::Mat matrix(Picture<Format>& frame) {
    return {120, 160, bytes_per_pixel(Format) == 1 ? CV_8UC1 : CV_8UC3, frame.pixels.data()};
}

double difference(const cv::Mat& left, const cv::Mat& right) { return cv::norm(left, right, cv::NORM_INF); }

class Recording : public testing::Test {
  protected:
    std::string written(const std::string& name, const cv::Mat& image) {
        EXPECT_TRUE(cv::imwrite(folder / name, image));
        return folder / name;
    }

    std::string video(int frames, cv::Size size = {160, 120}) {
        const std::string path = folder / "video.avi";
        cv::VideoWriter writer{path, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 50, size};
        for (int number = 1; number <= frames; ++number) {
            writer.write(picture(number, size));
        }
        return path;
    }

    Folder folder{};
    const FrameShape colour{160, 120, PixelFormat::bgr8};
    Frame<160, 120, PixelFormat::bgr8> frame{};
};

TEST_F(Recording, ImagesComeAsTheyAreInEveryFormat) {
    std::vector<std::string> paths;
    for (int number = 1; number <= 3; ++number) {
        paths.push_back(written("i" + std::to_string(number) + ".png", picture(number)));
    }
    Picture<PixelFormat::mono8> mono;
    Picture<PixelFormat::rgb8> rgb;
    auto as_mono = ImageSequence::open(paths, {.shape = mono.shape, .period_ns = 10});
    auto as_bgr = ImageSequence::open(paths, {.shape = frame.shape, .period_ns = 10});
    auto as_rgb = ImageSequence::open(paths, {.shape = rgb.shape, .period_ns = 10});
    for (int number = 1; number <= 3; ++number) {
        ASSERT_TRUE(as_mono->grab(mono.view(), watchdog));
        ASSERT_TRUE(as_rgb->grab(rgb.view(), watchdog));
        const Grab got = as_bgr->grab(frame.view(), watchdog);
        EXPECT_EQ(got.sequence, static_cast<std::uint64_t>(number));
        EXPECT_EQ(got.stamp_ns, 10 * (number - 1));
        const cv::Mat expected = picture(number);
        cv::Mat converted;
        EXPECT_EQ(difference(matrix(frame), expected), 0);
        cv::cvtColor(expected, converted, cv::COLOR_BGR2RGB);
        EXPECT_EQ(difference(matrix(rgb), converted), 0);
        cv::cvtColor(expected, converted, cv::COLOR_BGR2GRAY);
        EXPECT_LE(difference(matrix(mono), converted), 1);
    }
}

TEST_F(Recording, AVideoComesAsItIsButForItsCompression) {
    Picture<PixelFormat::mono8> mono;
    Picture<PixelFormat::rgb8> rgb;
    const std::string path = video(4);
    auto as_mono = Capture::file(path, {.shape = mono.shape});
    auto as_bgr = Capture::file(path, {.shape = frame.shape});
    auto as_rgb = Capture::file(path, {.shape = rgb.shape, .period_ns = 5});
    for (int number = 1; number <= 4; ++number) {
        ASSERT_TRUE(as_mono->grab(mono.view(), watchdog));
        EXPECT_EQ(as_rgb->grab(rgb.view(), watchdog).stamp_ns, 5 * (number - 1));
        EXPECT_EQ(as_bgr->grab(frame.view(), watchdog).stamp_ns, 20'000'000 * (number - 1)) << "50 a second";
        EXPECT_LT(cv::norm(matrix(frame), picture(number), cv::NORM_L1) / (3 * 160 * 120), 4);
        cv::Mat converted;
        cv::cvtColor(matrix(frame), converted, cv::COLOR_BGR2RGB);
        EXPECT_EQ(difference(matrix(rgb), converted), 0);
        cv::cvtColor(matrix(frame), converted, cv::COLOR_BGR2GRAY);
        EXPECT_LE(difference(matrix(mono), converted), 1);
    }
    EXPECT_EQ(as_bgr->grab(frame.view(), watchdog).outcome, Outcome::end_of_stream);
}

TEST_F(Recording, AnImageOfAnotherSizeIsSaidAndTheNextOneComes) {
    auto images = ImageSequence::open({written("1.png", picture(1)), written("2.png", picture(2, {320, 240})),
                                       written("3.png", picture(3, {80, 60})), written("4.png", picture(4))},
                                      {.shape = colour});
    EXPECT_TRUE(images->grab(frame.view(), watchdog));
    EXPECT_EQ(images->grab(frame.view(), watchdog).outcome, Outcome::other_shape);
    EXPECT_EQ(images->grab(frame.view(), watchdog).outcome, Outcome::other_shape);
    const Grab last = images->grab(frame.view(), watchdog);
    EXPECT_EQ(last.sequence, 4u);
    EXPECT_EQ(last.lost, 2u);
    EXPECT_EQ(difference(matrix(frame), picture(4)), 0);
}

TEST_F(Recording, WhatIsNoImageIsSaidAndTheNextOneComes) {
    const std::string prose = folder / "2.png";
    std::ofstream{prose} << "no image";
    const std::string cut = written("3.png", picture(3));
    cut_off(cut);
    const std::string empty = folder / "4.png";
    std::ofstream{empty};
    auto images = ImageSequence::open({written("1.png", picture(1)), prose, cut, empty, folder / "absent.png",
                                       folder / "", written("6.png", picture(6))},
                                      {.shape = colour});
    EXPECT_TRUE(images->grab(frame.view(), watchdog));
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(images->grab(frame.view(), watchdog).outcome, Outcome::damaged) << i;
    }
    EXPECT_EQ(images->grab(frame.view(), watchdog).lost, 5u);
    EXPECT_EQ(difference(matrix(frame), picture(6)), 0);
}

TEST_F(Recording, AVideoThatIsCutOffEnds) {
    const std::string path = video(40);
    cut_off(path);
    auto capture = Capture::file(path, {.shape = colour});
    // Without its index some libraries do not take it for a video at all.
    if (!capture) {
        EXPECT_EQ(capture.failure().error, OpenError::not_readable);
        return;
    }
    int frames = 0;
    Grab got{};
    while ((got = capture->grab(frame.view(), watchdog)).outcome == Outcome::frame ||
           got.outcome == Outcome::damaged) {
        ASSERT_LT(++frames, 41);
    }
    EXPECT_EQ(got.outcome, Outcome::end_of_stream);
    EXPECT_LT(frames, 40);
}

void expect_failure(const OpenFailure& failure, OpenError error, const std::string& word) {
    EXPECT_EQ(failure.error, error) << text(failure.error);
    EXPECT_NE(failure.text.find(word), std::string::npos) << failure.text;
}

TEST_F(Recording, WhatCannotBeOpenedIsToldAndWhy) {
    const std::string absent = folder / "absent";
    expect_failure(Capture::file(absent, {.shape = colour}).failure(), OpenError::not_found, absent);
    expect_failure(ImageSequence::open({absent}, {.shape = colour}).failure(), OpenError::not_found, absent);
    expect_failure(Capture::device(4711, {.shape = colour}).failure(), OpenError::not_found, "/dev/video4711");

    const std::string prose = folder / "prose.avi";
    std::ofstream{prose} << "Sing, O goddess, the anger of Achilles son of Peleus\n";
    expect_failure(Capture::file(prose, {.shape = colour}).failure(), OpenError::not_readable, prose);
    expect_failure(ImageSequence::open({prose}, {.shape = colour}).failure(), OpenError::not_readable, prose);

    const std::string small = written("small.png", picture(1, {80, 60}));
    expect_failure(ImageSequence::open({small}, {.shape = colour}).failure(), OpenError::other_shape, "80 x 60");
    expect_failure(Capture::file(video(3, {320, 240}), {.shape = colour}).failure(), OpenError::other_shape,
                   "320 x 240");

    expect_failure(ImageSequence::open({}, {.shape = colour}).failure(), OpenError::refused, "needs");
    expect_failure(ImageSequence::open({small}, {.shape = colour, .period_ns = 0}).failure(), OpenError::refused,
                   "period");
}

TEST(Numbered, NamesFilesAsPrintfDoes) {
    EXPECT_EQ(numbered("a.%04d.png", 9, 11), (std::vector<std::string>{"a.0009.png", "a.0010.png", "a.0011.png"}));
    EXPECT_EQ(numbered("%d", -1, 0), (std::vector<std::string>{"-1", "0"}));
    EXPECT_TRUE(numbered("%d", 1, 0).empty());
    for (const char* wrong : {"a.png", "%s", "%d%d", "%n", "%", "a%999999999d", "%-4d", "%d %n"}) {
        EXPECT_THROW(numbered(wrong, 1, 2), std::invalid_argument) << wrong;
    }
}

}  // namespace
}  // namespace groundstate::opencv
