// Occlusion, blur and noise; see the header.
#include "groundstate/simulated/lens.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "picture.hpp"

namespace groundstate::simulated {
namespace {

cv::Rect rect_of(const Box& box) { return {box.left, box.top, box.width, box.height}; }

// The box and so many pixels around it, as far as they are in the picture.
cv::Rect widened(const Box& box, int by, const FrameShape& shape) {
    const cv::Rect whole{0, 0, shape.width, shape.height};
    return cv::Rect{box.left - by, box.top - by, box.width + 2 * by, box.height + 2 * by} & whole;
}

}  // namespace

Lens::Lens(const Faults& faults, const FrameShape& shape) : faults_{faults}, field_width_{shape.row_bytes() + margin} {
    if (!(faults.noise > 0)) {
        return;
    }
    const std::size_t size = field_width_ * (static_cast<std::size_t>(shape.height) + margin);
    brighter_.resize(size);
    darker_.resize(size);
    cv::RNG random{faults.seed};
    for (std::size_t i = 0; i < size; ++i) {
        const long step = std::lround(random.gaussian(faults.noise));
        brighter_[i] = static_cast<std::uint8_t>(std::clamp(step, 0l, 255l));
        darker_[i] = static_cast<std::uint8_t>(std::clamp(-step, 0l, 255l));
    }
}

std::size_t Lens::covered(std::uint64_t frame, std::size_t discs) const noexcept {
    for (std::uint64_t back = 0; back < faults_.occluded_frames && back < frame; ++back) {
        if (falls(faults_.occluded, faults_.seed, Lot::occluded, frame - back)) {
            return discs == 0 ? discs : lot(faults_.seed, Lot::disc, frame - back) % discs;
        }
    }
    return discs;
}

void Lens::spoil(std::uint64_t frame, const Scene& scene, const Pose& camera, FrameView picture) const {
    cover(frame, scene, camera, picture);
    if (faults_.blur > 0) {
        blur(scene, camera, picture);
    }
    if (!brighter_.empty()) {
        add_noise(frame, picture);
    }
}

void Lens::cover(std::uint64_t frame, const Scene& scene, const Pose& camera, FrameView picture) const {
    const std::size_t disc = covered(frame, scene.discs().size());
    if (disc == scene.discs().size()) {
        return;
    }
    const Box box = scene.bounds(disc, camera, picture.shape);
    if (box.width > 0) {
        picture_of(picture)(rect_of(box)).setTo(cv::Scalar::all(scene.background() / 2));
    }
}

// The background is the same everywhere, so it is enough to blur what surrounds the discs; where two of these parts
// meet they would be blurred twice, and all is blurred instead.
void Lens::blur(const Scene& scene, const Pose& camera, FrameView picture) const {
    const cv::Mat image = picture_of(picture);
    const int reach = static_cast<int>(std::ceil(4 * faults_.blur)) + 1;
    std::array<cv::Rect, Scene::most_discs> parts{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene.discs().size(); ++i) {
        const Box box = scene.bounds(i, camera, picture.shape);
        if (box.width == 0) {
            continue;
        }
        const cv::Rect part = widened(box, reach, picture.shape);
        for (std::size_t k = 0; k < count; ++k) {
            if ((parts[k] & part).area() > 0) {
                cv::GaussianBlur(image, image, {}, faults_.blur);
                return;
            }
        }
        parts[count++] = part;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const cv::Mat part = image(parts[k]);
        cv::GaussianBlur(part, part, {}, faults_.blur);
    }
}

void Lens::add_noise(std::uint64_t frame, FrameView picture) const {
    const std::uint64_t drawn = lot(faults_.seed, Lot::noise, frame);
    const std::size_t from = drawn % margin * field_width_ + drawn / margin % margin;
    const int rows = picture.shape.height;
    const int columns = static_cast<int>(picture.shape.row_bytes());
    cv::Mat bytes{rows, columns, CV_8UC1, picture.pixels, picture.stride_bytes};
    // OpenCV has no matrix of constant memory; these two are only read.
    const auto field = [&](const std::vector<std::uint8_t>& noise) {
        return cv::Mat{rows, columns, CV_8UC1, const_cast<std::uint8_t*>(noise.data()) + from, field_width_};
    };
    cv::add(bytes, field(brighter_), bytes);
    cv::subtract(bytes, field(darker_), bytes);
}

}  // namespace groundstate::simulated
