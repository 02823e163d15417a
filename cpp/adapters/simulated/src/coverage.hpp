// How much of each pixel a polygon covers: exactly, as an area, so that the centre of what is drawn is the centre of
// the polygon and its weight the area.
//
// Each edge adds, in the rows that it crosses, what lies to the right of it; running sums along the rows then are the
// coverage. Pixel (x, y) is the unit square from (x, y) to (x + 1, y + 1).
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "groundstate/simulated/scene.hpp"

namespace groundstate::simulated {

/// The coverage of one polygon over one box of pixels.
class Coverage {
  public:
    /// Makes room for boxes up to that size, so that nothing is allocated later.
    void reserve(int width, int height) { sums_.reserve(room(width, height)); }

    /// Corners in order, either way round, relative to the box; what reaches over it to the left is cut, and to the
    /// right, above and below left out.
    void measure(std::span<const Pixel> corners, int width, int height) {
        width_ = width;
        height_ = height;
        sums_.assign(room(width, height), 0.0f);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            add_edge(corners[i], corners[(i + 1) % corners.size()]);
        }
    }

    /// Calls `paint(x, y, covered)` for each pixel of which more than nothing is covered, 0 < covered <= 1.
    template <class Paint>
    void each(Paint&& paint) const {
        for (int y = 0; y < height_; ++y) {
            const float* sums = &sums_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 2)];
            float sum = 0;
            for (int x = 0; x < width_; ++x) {
                sum += sums[x];
                const float covered = std::abs(sum);
                if (covered > 1e-4f) {
                    paint(x, y, std::min(covered, 1.0f));
                }
            }
        }
    }

  private:
    // A row has two sums more than pixels: for what lies right of its last one.
    static std::size_t room(int width, int height) {
        return static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height);
    }

    void add_edge(const Pixel& from, const Pixel& to) {
        const bool down = from.y < to.y;
        const Pixel& upper = down ? from : to;
        const Pixel& lower = down ? to : from;
        const double slope = (lower.x - upper.x) / (lower.y - upper.y);
        const int first = std::max(0, static_cast<int>(std::floor(upper.y)));
        const int last = std::min(height_, static_cast<int>(std::ceil(lower.y)));
        for (int y = first; y < last; ++y) {
            const double y0 = std::max<double>(y, upper.y);
            const double y1 = std::min<double>(y + 1, lower.y);
            if (y1 > y0) {
                const double x0 = upper.x + slope * (y0 - upper.y);
                const double x1 = upper.x + slope * (y1 - upper.y);
                add_piece(y, down ? y1 - y0 : y0 - y1, std::min(x0, x1), std::max(x0, x1));
            }
        }
    }

    // A piece of an edge within one row, of that height, from x0 to x1.
    void add_piece(int y, double height, double x0, double x1) {
        float* sums = &sums_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 2)];
        x0 = std::clamp<double>(x0, 0, width_);
        x1 = std::clamp<double>(x1, 0, width_);
        const int first = static_cast<int>(x0);
        const int last = static_cast<int>(x1);
        double before = 0;  // what is covered right of the piece, up to the left side of pixel x
        for (int x = first; x <= last; ++x) {
            // The part of the piece's height that is crossed before the right side of this pixel, and the area that
            // lies to the right of it within the pixel.
            const double until = std::min<double>(x + 1, x1);
            const double since = std::max<double>(x, x0);
            const double share = x1 > x0 ? (until - since) / (x1 - x0) : 1;
            const double crossed = x1 > x0 ? (since - x0) / (x1 - x0) : 0;
            const double area = crossed + share * (x + 1 - 0.5 * (since + until));
            sums[x] += static_cast<float>(height * (area - before));
            before = area;
        }
        sums[last + 1] += static_cast<float>(height * (1 - before));
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<float> sums_{};
};

}  // namespace groundstate::simulated
