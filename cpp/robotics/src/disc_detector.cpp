// Discs by threshold, connected components and moments, with OpenCV.
#include "groundstate/vision/disc_detector.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace groundstate::vision {

namespace {

// Grey levels nearer to the background's than this share of the contrast weigh nothing: noise.
constexpr double noise_share = 0.3;

cv::Mat matrix(ConstFrameView image) {
    // OpenCV has no matrix of constants; it is read only.
    return {image.shape.height, image.shape.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels), image.stride_bytes};
}

double aspect(const cv::Moments& moments) {
    const double half_trace = (moments.mu20 + moments.mu02) / 2;
    const double root = std::hypot((moments.mu20 - moments.mu02) / 2, moments.mu11);
    return half_trace > root ? std::sqrt((half_trace + root) / (half_trace - root)) : INFINITY;
}

}  // namespace

struct DiscDetector::Buffers {
    cv::Mat binary, labels, statistics, centroids, weights;
    cv::Mat table{1, 256, CV_8UC1, cv::Scalar{0}};
    std::vector<Disc> found{};
    bool levelled = false;

    // From the grey levels of both sides of the threshold to weights 0..255.
    void level(double background, double disc) {
        for (int grey = 0; grey < 256; ++grey) {
            const double share = (grey - background) / (disc - background);
            const double weight = (share - noise_share) / (1 - noise_share);
            table.at<std::uint8_t>(grey) = static_cast<std::uint8_t>(std::lround(std::clamp(weight, 0.0, 1.0) * 255));
        }
        levelled = true;
    }
};

DiscDetector::DiscDetector(int width, int height, const DiscSettings& settings)
    : settings_{settings}, buffers_{std::make_unique<Buffers>()} {
    buffers_->binary.create(height, width, CV_8UC1);
    buffers_->labels.create(height, width, CV_32SC1);
    buffers_->weights.create(height, width, CV_8UC1);
    buffers_->found.reserve(most_found);
}

DiscDetector::~DiscDetector() = default;

const std::vector<Disc>& DiscDetector::search(ConstFrameView image) {
    Buffers& b = *buffers_;
    b.found.clear();
    const cv::Mat grey = matrix(image);
    const int kind = settings_.dark ? cv::THRESH_BINARY_INV : cv::THRESH_BINARY;
    cv::threshold(grey, b.binary, settings_.level, 255, settings_.level < 0 ? kind | cv::THRESH_OTSU : kind);
    const int parts = cv::connectedComponentsWithStats(b.binary, b.labels, b.statistics, b.centroids, 8, CV_32S);

    // Components that may be discs: by area, and because a disc fills pi/4 of the box around it, however seen.
    struct Candidate {
        int label;
        int area;
    };
    std::vector<Candidate> candidates;
    for (int label = 1; label < parts; ++label) {
        const int* s = b.statistics.ptr<int>(label);
        const double box = static_cast<double>(s[cv::CC_STAT_WIDTH]) * s[cv::CC_STAT_HEIGHT];
        const double filled = s[cv::CC_STAT_AREA] / box;
        if (s[cv::CC_STAT_AREA] >= settings_.least_area && s[cv::CC_STAT_AREA] <= settings_.most_area &&
            filled > 0.5 && filled < 0.95) {
            candidates.push_back({label, s[cv::CC_STAT_AREA]});
        }
    }
    if (candidates.empty()) {
        return b.found;
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& l, const Candidate& r) { return std::pair{-l.area, l.label} < std::pair{-r.area, r.label}; });
    candidates.resize(std::min(candidates.size(), most_found));

    // The levels: the background's all over, the discs' in the middles of the candidates.
    const double background = cv::mean(grey, settings_.dark ? ~b.binary : b.binary)[0];
    const double around = settings_.dark ? background : cv::mean(grey, ~b.binary)[0];
    double disc = 0;
    for (const Candidate& candidate : candidates) {
        const double* c = b.centroids.ptr<double>(candidate.label);
        disc += grey.at<std::uint8_t>(static_cast<int>(c[1]), static_cast<int>(c[0]));
    }
    disc /= static_cast<double>(candidates.size());
    if (std::abs(disc - around) < 1) {
        return b.found;
    }
    b.level(around, disc);

    for (const Candidate& candidate : candidates) {
        const int* s = b.statistics.ptr<int>(candidate.label);
        const servo::Pixel middle{s[cv::CC_STAT_LEFT] + (s[cv::CC_STAT_WIDTH] - 1) / 2.0,
                                  s[cv::CC_STAT_TOP] + (s[cv::CC_STAT_HEIGHT] - 1) / 2.0};
        const double reach = std::max(s[cv::CC_STAT_WIDTH], s[cv::CC_STAT_HEIGHT]) / 2.0 + 4;
        if (const auto measured = near(image, middle, reach)) {
            b.found.push_back(*measured);
        }
    }
    return b.found;
}

std::optional<Disc> DiscDetector::near(ConstFrameView image, servo::Pixel place, double reach) {
    Buffers& b = *buffers_;
    if (!b.levelled || !std::isfinite(place.u) || !std::isfinite(place.v) || !(reach > 0)) {
        return std::nullopt;
    }
    const cv::Rect whole{0, 0, image.shape.width, image.shape.height};
    const auto bounded = [](double value, int most) {
        return static_cast<int>(std::clamp(value, -1.0, static_cast<double>(most) + 1));
    };
    const int left = bounded(std::floor(place.u - reach), image.shape.width);
    const int top = bounded(std::floor(place.v - reach), image.shape.height);
    const int right = bounded(std::ceil(place.u + reach), image.shape.width);
    const int bottom = bounded(std::ceil(place.v + reach), image.shape.height);
    const cv::Rect region = cv::Rect{left, top, right - left + 1, bottom - top + 1} & whole;
    if (region.width < 3 || region.height < 3) {
        return std::nullopt;
    }
    cv::Mat weights = b.weights(cv::Rect{0, 0, region.width, region.height});
    cv::LUT(matrix(image)(region), b.table, weights);

    // What touches the region's border is not seen whole.
    const auto border = [&](const cv::Mat& strip) { return cv::norm(strip, cv::NORM_L1); };
    if (border(weights.row(0)) + border(weights.row(region.height - 1)) + border(weights.col(0)) +
            border(weights.col(region.width - 1)) >
        2 * 255) {
        return std::nullopt;
    }
    const cv::Moments moments = cv::moments(weights);
    const double area = moments.m00 / 255;
    const double shape = area > 0 ? aspect(moments) : INFINITY;
    if (area < settings_.least_area || area > settings_.most_area || shape > settings_.most_aspect) {
        return std::nullopt;
    }
    // An ellipse has sqrt(mu20 mu02 - mu11^2) = area^2 / (4 pi) of its normalised moments; scattered things have more.
    const double spread = std::sqrt(std::max(0.0, moments.mu20 * moments.mu02 - moments.mu11 * moments.mu11)) / 255;
    if (spread > 1.25 * area * area / (4 * M_PI)) {
        return std::nullopt;
    }
    return Disc{{region.x + moments.m10 / moments.m00, region.y + moments.m01 / moments.m00}, area, shape};
}

}  // namespace groundstate::vision
