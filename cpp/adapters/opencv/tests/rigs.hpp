// Recordings as the conformance suite wants them, made by OpenCV itself: image files and a video.
#pragma once

#include "../../conformance/frame_source_suite.hpp"

#include <filesystem>
#include <fstream>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <groundstate/opencv/capture.hpp>
#include <groundstate/opencv/image_sequence.hpp>

namespace groundstate::opencv {

/// A folder of its own, gone in the end.
class Folder {
  public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "groundstate-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path_); }

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_{};
};

/// Another picture for each number: grey steps, a coloured disc that wanders.
inline cv::Mat picture(int number, cv::Size size = {160, 120}) {
    cv::Mat image{size, CV_8UC3};
    for (int x = 0; x < size.width; ++x) {
        image.col(x).setTo(cv::Scalar::all(x / 16 * 16));
    }
    cv::circle(image, {20 + 2 * number, 60}, 15, {40, 120, 220}, cv::FILLED);
    return image;
}

inline void cut_off(const std::string& path) {
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
}

template <PixelFormat Format>
struct ImagesRig {
    using Source = ImageSequence;
    static constexpr bool allocates = true;

    Opened<Source> open(const conformance::Script& script) {
        const int frames = static_cast<int>(script.frames);
        const auto paths = numbered(folder / "image.%04d.png", 1, frames);
        for (int number = 1; number <= frames; ++number) {
            const std::string& path = paths[static_cast<std::size_t>(number - 1)];
            cv::imwrite(path, picture(number));
            if (script.damages && number % 5 == 3) {
                cut_off(path);
            } else if (script.damages && number % 5 == 4) {
                std::ofstream{path} << "no image";
            } else if (script.damages && number % 7 == 5) {
                std::filesystem::remove(path);
            }
        }
        return Source::open(paths, {.shape = {160, 120, Format}});
    }
    void pass() {}

    Folder folder{};
};

template <PixelFormat Format>
struct VideoRig {
    using Source = Capture;
    static constexpr bool allocates = true;

    Opened<Source> open(const conformance::Script& script) {
        cv::VideoWriter writer{folder / "video.avi", cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                               50, cv::Size{160, 120}};
        for (int number = 1; number <= static_cast<int>(script.frames); ++number) {
            writer.write(picture(number));
        }
        writer.release();
        return Source::file(folder / "video.avi", {.shape = {160, 120, Format}});
    }
    void pass() {}

    Folder folder{};
};

using ImageRigs = testing::Types<ImagesRig<PixelFormat::mono8>, ImagesRig<PixelFormat::bgr8>,
                                 ImagesRig<PixelFormat::rgb8>>;
using VideoRigs = testing::Types<VideoRig<PixelFormat::mono8>, VideoRig<PixelFormat::bgr8>,
                                 VideoRig<PixelFormat::rgb8>>;

}  // namespace groundstate::opencv
