// Discs by threshold, connected components and moments, with OpenCV.
#include "groundstate/vision/disc_detector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#if __has_include(<opencv2/geometry.hpp>)
#include <opencv2/geometry.hpp>  // where OpenCV 5 has the moments
#endif

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
    cv::Mat binary, labels, statistics, centroids, weights, alone;
    std::vector<cv::Point> open{};
    cv::Mat table{1, 256, CV_8UC1, cv::Scalar{0}};
    std::vector<Disc> found{};
    bool levelled = false;
    double background = 0;  // grey levels of the last search
    double disc = 0;

    // From grey levels to weights 0..255. The background's level is that of the region, of what is not nearer to the
    // disc's: light falls unevenly on real things.
    void weigh(const cv::Mat& grey, cv::Mat& into) {
        const double between = (background + disc) / 2;
        const bool dark = disc < background;
        long sum = 0;
        long count = 0;
        for (int v = 0; v < grey.rows; ++v) {
            const std::uint8_t* row = grey.ptr<std::uint8_t>(v);
            for (int u = 0; u < grey.cols; ++u) {
                if ((row[u] > between) == dark) {
                    sum += row[u];
                    ++count;
                }
            }
        }
        const double around = count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : background;
        for (int level = 0; level < 256; ++level) {
            const double weight = ((level - around) / (disc - around) - noise_share) / (1 - noise_share);
            table.at<std::uint8_t>(level) = static_cast<std::uint8_t>(std::lround(std::clamp(weight, 0.0, 1.0) * 255));
        }
        cv::LUT(grey, table, into);
    }

    // Moves what is connected to the heavy pixel nearest to the place from `from` to `to`, which is empty: on a real
    // background something else may be within reach. Nothing if all is light.
    void isolate(cv::Mat& from, cv::Mat& to, double x, double y) {
        double nearest = INFINITY;
        cv::Point seed;
        for (int v = 0; v < from.rows; ++v) {
            const std::uint8_t* row = from.ptr<std::uint8_t>(v);
            for (int u = 0; u < from.cols; ++u) {
                const double square = (u - x) * (u - x) + (v - y) * (v - y);
                if (row[u] > 127 && square < nearest) {
                    nearest = square;
                    seed = {u, v};
                }
            }
        }
        open.clear();
        const auto take = [&](int u, int v) {
            std::uint8_t& weight = from.at<std::uint8_t>(v, u);
            if (weight != 0) {
                to.at<std::uint8_t>(v, u) = std::exchange(weight, std::uint8_t{0});
                open.push_back({u, v});
            }
        };
        if (nearest < INFINITY) {
            take(seed.x, seed.y);
        }
        while (!open.empty()) {
            const cv::Point at = open.back();
            open.pop_back();
            for (int v = std::max(at.y - 1, 0); v <= std::min(at.y + 1, from.rows - 1); ++v) {
                for (int u = std::max(at.x - 1, 0); u <= std::min(at.x + 1, from.cols - 1); ++u) {
                    take(u, v);
                }
            }
        }
    }
};

DiscDetector::DiscDetector(int width, int height, const DiscSettings& settings)
    : settings_{settings}, buffers_{std::make_unique<Buffers>()} {
    // A search would be shared among threads of OpenCV's own, which no schedule of ours knows, and waited for.
    cv::setNumThreads(1);
    buffers_->binary.create(height, width, CV_8UC1);
    buffers_->labels.create(height, width, CV_32SC1);
    buffers_->weights.create(height, width, CV_8UC1);
    buffers_->alone.create(height, width, CV_8UC1);
    buffers_->open.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
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
    b.background = around;
    b.disc = disc;
    b.levelled = true;

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
    cv::Mat all = b.weights(cv::Rect{0, 0, region.width, region.height});
    b.weigh(matrix(image)(region), all);
    cv::Mat weights = b.alone(cv::Rect{0, 0, region.width, region.height});
    weights.setTo(0);
    b.isolate(all, weights, place.u - region.x, place.v - region.y);

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
