// Four discs from image to image.
#include "groundstate/vision/disc_tracker.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace groundstate::vision {

using servo::Pixel;
using servo::Pixels;
constexpr std::size_t points = servo::points;

namespace {

using Set = std::array<Disc, points>;

double distance(Pixel a, Pixel b) noexcept { return std::hypot(a.u - b.u, a.v - b.v); }

// Clockwise as seen in the image (v points down).
void order_around(Set& set) noexcept {
    Pixel middle{};
    for (const Disc& disc : set) {
        middle.u += disc.centre.u / points;
        middle.v += disc.centre.v / points;
    }
    const auto angle = [&](const Disc& d) { return std::atan2(d.centre.v - middle.v, d.centre.u - middle.u); };
    std::sort(set.begin(), set.end(), [&](const Disc& l, const Disc& r) { return angle(l) < angle(r); });
}

bool convex(const Set& set) noexcept {
    for (std::size_t i = 0; i < points; ++i) {
        const Pixel a = set[i].centre;
        const Pixel b = set[(i + 1) % points].centre;
        const Pixel c = set[(i + 2) % points].centre;
        if ((b.u - a.u) * (c.v - b.v) - (b.v - a.v) * (c.u - b.u) <= 0) {
            return false;
        }
    }
    return true;
}

double likeness(const Set& set) noexcept {
    const auto [least, most] =
        std::minmax_element(set.begin(), set.end(), [](const Disc& l, const Disc& r) { return l.area < r.area; });
    return most->area / least->area;
}

// The sum of squared distances to where they are expected, if the set is numbered from `first` on.
double misfit(const Set& set, std::size_t first, const Pixels& expected, double& farthest) noexcept {
    double sum = 0;
    farthest = 0;
    for (std::size_t i = 0; i < points; ++i) {
        const double d = distance(set[(first + i) % points].centre, expected[i]);
        sum += d * d;
        farthest = std::max(farthest, d);
    }
    return sum;
}

}  // namespace

void DiscTracker::expect(const Pixels& pixels) noexcept {
    expected_ = pixels;
    expecting_ = true;
}

void DiscTracker::give_up() noexcept {
    expect(present_.pixels);
    present_ = {};
}

const Tracked& DiscTracker::look(ConstFrameView image, std::int64_t captured_ns) {
    if (present_.track == Track::searching) {
        search(image);
    } else {
        follow(image, captured_ns);
        if (present_.predicted_images > settings_.most_predicted) {
            give_up();
            search(image);
        }
    }
    captured_ns_ = captured_ns;
    return present_;
}

void DiscTracker::search(ConstFrameView image) {
    ++searches_;
    const std::vector<Disc>& found = detector_.search(image);
    double best = INFINITY;
    Set chosen{};
    std::size_t chosen_first = 0;
    const std::size_t n = found.size();
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = a + 1; b < n; ++b) {
            for (std::size_t c = b + 1; c < n; ++c) {
                for (std::size_t d = c + 1; d < n; ++d) {
                    Set set{found[a], found[b], found[c], found[d]};
                    order_around(set);
                    if (!convex(set) || likeness(set) > settings_.most_alike) {
                        continue;
                    }
                    for (std::size_t first = 0; first < points; ++first) {
                        double farthest = 0;
                        // Without expectations: the discs most alike, from the one nearest to the corner.
                        const double fit = expecting_ ? misfit(set, first, expected_, farthest)
                                                      : 1e6 * likeness(set) + distance(set[first].centre, {});
                        if (fit < best && farthest <= settings_.most_distance) {
                            best = fit;
                            chosen = set;
                            chosen_first = first;
                        }
                    }
                }
            }
        }
    }
    if (!(best < INFINITY)) {
        return;
    }
    present_ = {.track = Track::tracking};
    for (std::size_t i = 0; i < points; ++i) {
        const Disc& disc = chosen[(chosen_first + i) % points];
        present_.pixels[i] = disc.centre;
        present_.areas[i] = disc.area;
        present_.measured[i] = true;
    }
    velocity_ = {};
    whole_ = present_.pixels;
}

void DiscTracker::follow(ConstFrameView image, std::int64_t captured_ns) {
    const double dt = static_cast<double>(captured_ns - captured_ns_) * 1e-9;
    Pixels moved{};
    Tracked next{.track = Track::tracking, .areas = present_.areas};
    for (std::size_t i = 0; i < points; ++i) {
        moved[i] = {present_.pixels[i].u + velocity_[i].u * dt, present_.pixels[i].v + velocity_[i].v * dt};
        const double radius = std::sqrt(present_.areas[i] / M_PI);
        const double speed = std::hypot(velocity_[i].u, velocity_[i].v);
        const double reach = 1.5 * radius + 6 + std::min(0.5 * speed * dt, 2 * radius);
        const auto disc = detector_.near(image, moved[i], reach);
        if (!disc || disc->area > present_.areas[i] * settings_.most_jump ||
            disc->area * settings_.most_jump < present_.areas[i]) {
            continue;
        }
        const bool taken = [&] {
            for (std::size_t j = 0; j < i; ++j) {
                if (next.measured[j] && distance(next.pixels[j], disc->centre) < radius) {
                    return true;
                }
            }
            return false;
        }();
        if (!taken) {
            next.pixels[i] = disc->centre;
            next.areas[i] = disc->area;
            next.measured[i] = true;
        }
    }

    if (std::all_of(next.measured.begin(), next.measured.end(), [](bool m) { return m; })) {
        whole_ = next.pixels;
    } else {
        next.track = Track::predicting;
        next.predicted_images = present_.predicted_images + 1;
        predict(next, moved);
    }
    for (std::size_t i = 0; i < points && dt > 0; ++i) {
        velocity_[i] = {(next.pixels[i].u - present_.pixels[i].u) / dt, (next.pixels[i].v - present_.pixels[i].v) / dt};
    }
    present_ = next;
}

void DiscTracker::predict(Tracked& next, const Pixels& moved) const noexcept {
    Eigen::Matrix3d from = Eigen::Matrix3d::Ones();
    Eigen::Matrix<double, 2, 3> to = Eigen::Matrix<double, 2, 3>::Zero();
    Eigen::Index seen = 0;
    for (std::size_t i = 0; i < points && seen < 3; ++i) {
        if (next.measured[i]) {
            from.col(seen).head<2>() << whole_[i].u, whole_[i].v;
            to.col(seen) << next.pixels[i].u, next.pixels[i].v;
            ++seen;
        }
    }
    Eigen::Matrix<double, 2, 3> affine = Eigen::Matrix<double, 2, 3>::Zero();
    const bool mapped = seen == 3 && std::abs(from.determinant()) > 1;
    if (mapped) {
        affine = to * from.inverse();
    }
    for (std::size_t i = 0; i < points; ++i) {
        if (next.measured[i]) {
            continue;
        }
        next.pixels[i] = moved[i];
        if (mapped) {
            const Eigen::Vector2d place = affine * Eigen::Vector3d{whole_[i].u, whole_[i].v, 1};
            next.pixels[i] = {place.x(), place.y()};
        }
    }
}

}  // namespace groundstate::vision
