// Pictures with OpenCV.
#include "pictures.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace controller_system {

using namespace groundstate;

namespace {

constexpr int finer = 4;  // binary digits of the parts of a pixel
const cv::Scalar colours[servo::points] = {{80, 80, 255}, {80, 200, 80}, {255, 150, 50}, {60, 200, 255}};

cv::Point at(const servo::Pixel& pixel) {
    return {static_cast<int>(std::lround(pixel.u * (1 << finer))), static_cast<int>(std::lround(pixel.v * (1 << finer)))};
}

void draw_way(cv::Mat& picture, const std::vector<Sight>& sights, std::int64_t until_ns, std::int64_t target) {
    const Sight* before = nullptr;
    for (const Sight& sight : sights) {
        if (sight.captured_ns > until_ns) {
            break;
        }
        if (before != nullptr && sight.tracked && sight.target == target) {
            for (std::size_t i = 0; i < servo::points; ++i) {
                cv::line(picture, at(before->tracked.pixels[i]), at(sight.tracked.pixels[i]), colours[i], 2, cv::LINE_AA, finer);
            }
        }
        before = sight.tracked && sight.target == target ? &sight : nullptr;
    }
}

void draw_goal(cv::Mat& picture, const Loop& loop, std::int64_t target) {
    const Goal& goal = loop.goals[static_cast<std::size_t>(target - 1)];
    const servo::View view = loop.cell->view(loop.cell->settings().target.pose * goal.camera);
    for (std::size_t i = 0; i < servo::points; ++i) {
        const servo::Pixel pixel = loop.cell->settings().lens.pixel(view.seen[i]);
        for (const auto& [du, dv] : {std::pair{6.0, 6.0}, std::pair{6.0, -6.0}}) {
            cv::line(picture, at({pixel.u - du, pixel.v - dv}), at({pixel.u + du, pixel.v + dv}), colours[i], 2, cv::LINE_AA, finer);
        }
    }
}

}  // namespace

std::size_t write_pictures(const std::string& folder, const Loop& loop) {
    std::size_t written = 0;
    for (const Kept& kept : loop.servoing->kept()) {
        if (kept.target == 0) {
            continue;
        }
        cv::Mat picture;
        cv::cvtColor(cv::Mat{480, 640, CV_8UC1, kept.frame->pixels.data()}, picture, cv::COLOR_GRAY2BGR);
        draw_way(picture, loop.servoing->sights(), kept.captured_ns, kept.target);
        draw_goal(picture, loop, kept.target);
        for (std::size_t i = 0; i < servo::points && kept.tracked; ++i) {
            const int radius = static_cast<int>(std::lround(std::sqrt(kept.tracked.areas[i] / M_PI) * (1 << finer)));
            cv::circle(picture, at(kept.tracked.pixels[i]), radius, colours[i], kept.tracked.measured[i] ? 2 : 1, cv::LINE_AA, finer);
        }
        char told[64];
        std::snprintf(told, sizeof told, "%.2f s, goal %d", static_cast<double>(kept.captured_ns - loop.origin_ns) * 1e-9,
                      static_cast<int>(kept.target));
        cv::putText(picture, told, {12, 466}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {220, 220, 220}, 1, cv::LINE_AA);
        try {
            written += cv::imwrite(folder + "/view-" + std::to_string(written + 1) + ".png", picture);
        } catch (const cv::Exception&) {
            break;
        }
    }
    return written;
}

}  // namespace controller_system
