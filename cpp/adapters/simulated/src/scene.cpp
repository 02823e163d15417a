// Projection and drawing; see the header.
#include "groundstate/simulated/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "coverage.hpp"

namespace groundstate::simulated {
namespace {

constexpr double nearest_m = 1e-3;   // what is nearer to the lens cannot be projected
constexpr double far_outside = 1e5; // pixels; what reaches so far fills the picture, or is nowhere near it

Vector scaled(const Vector& a, double s) noexcept { return {a[0] * s, a[1] * s, a[2] * s}; }

Vector cross(const Vector& a, const Vector& b) noexcept {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(const Vector& a) noexcept {
    const double length = std::hypot(a[0], a[1], a[2]);
    return length > 0 ? scaled(a, 1 / length) : Vector{0, 0, 1};
}

// Two directions within the disc's plane, at right angles.
std::pair<Vector, Vector> directions(const Vector& normal) noexcept {
    const Vector n = unit(normal);
    const Vector beside = std::abs(n[0]) < 0.9 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector u = unit(cross(n, beside));
    return {u, cross(n, u)};
}

// The pixels from one corner to the other, as far as they are in the picture.
Box box_of(const Pixel& upper_left, const Pixel& lower_right, const FrameShape& shape) noexcept {
    const int left = std::max(0, static_cast<int>(std::floor(upper_left.x + 0.5)));
    const int top = std::max(0, static_cast<int>(std::floor(upper_left.y + 0.5)));
    const int right = std::min(shape.width, static_cast<int>(std::ceil(lower_right.x + 0.5)));
    const int bottom = std::min(shape.height, static_cast<int>(std::ceil(lower_right.y + 0.5)));
    return right <= left || bottom <= top ? Box{} : Box{left, top, right - left, bottom - top};
}

}  // namespace

Vector Pose::into_camera(const Vector& world) const noexcept {
    const Vector d{world[0] - position[0], world[1] - position[1], world[2] - position[2]};
    const auto& r = rotation;
    return {r[0] * d[0] + r[3] * d[1] + r[6] * d[2], r[1] * d[0] + r[4] * d[1] + r[7] * d[2],
            r[2] * d[0] + r[5] * d[1] + r[8] * d[2]};
}

Scene::Scene(std::vector<Disc> discs, const Intrinsics& intrinsics, std::uint8_t background)
    : discs_{std::move(discs)},
      intrinsics_{intrinsics},
      background_{background},
      coverage_{std::make_unique<Coverage>()} {
    discs_.resize(std::min(discs_.size(), most_discs));
    outlines_.resize(discs_.size());
    // The polygon has the disc's area: its corners lie a little outside.
    const double step = 2 * std::numbers::pi / corners;
    const double widened = std::sqrt(step / std::sin(step));
    for (std::size_t i = 0; i < discs_.size(); ++i) {
        const auto [u, v] = directions(discs_[i].normal);
        for (std::size_t k = 0; k < corners; ++k) {
            const Vector along_u = scaled(u, discs_[i].radius * widened * std::cos(static_cast<double>(k) * step));
            const Vector along_v = scaled(v, discs_[i].radius * widened * std::sin(static_cast<double>(k) * step));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                outlines_[i][k][axis] = discs_[i].centre[axis] + along_u[axis] + along_v[axis];
            }
        }
    }
}

Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

std::optional<Pixel> Scene::project(const Vector& world, const Pose& camera) const noexcept {
    const Vector p = camera.into_camera(world);
    if (!(p[2] > nearest_m)) {
        return std::nullopt;
    }
    return Pixel{intrinsics_.fx * p[0] / p[2] + intrinsics_.cx, intrinsics_.fy * p[1] / p[2] + intrinsics_.cy};
}

bool Scene::project_outline(std::size_t disc, const Pose& camera,
                            std::array<Pixel, corners>& picture) const noexcept {
    for (std::size_t k = 0; k < corners; ++k) {
        const auto corner = project(outlines_[disc][k], camera);
        if (!corner || !(std::abs(corner->x) < far_outside && std::abs(corner->y) < far_outside)) {
            return false;
        }
        picture[k] = *corner;
    }
    return true;
}

Box Scene::bounds(std::size_t disc, const Pose& camera, const FrameShape& shape) const noexcept {
    std::array<Pixel, corners> outline{};
    if (!project_outline(disc, camera, outline)) {
        return {};
    }
    const auto [left, right] = std::minmax_element(
        outline.begin(), outline.end(), [](const Pixel& one, const Pixel& other) { return one.x < other.x; });
    const auto [top, bottom] = std::minmax_element(
        outline.begin(), outline.end(), [](const Pixel& one, const Pixel& other) { return one.y < other.y; });
    return box_of({left->x, top->y}, {right->x, bottom->y}, shape);
}

void Scene::prepare(const FrameShape& shape) { coverage_->reserve(shape.width, shape.height); }

void Scene::draw(const Pose& camera, FrameView into) {
    for (int y = 0; y < into.shape.height; ++y) {
        std::memset(into.row(y), background_, into.shape.row_bytes());
    }
    std::array<Pixel, corners> outline{};
    for (std::size_t i = 0; i < discs_.size(); ++i) {
        const Box box = bounds(i, camera, into.shape);
        if (box.width == 0 || !project_outline(i, camera, outline)) {
            continue;
        }
        for (Pixel& corner : outline) {
            corner = {corner.x + 0.5 - box.left, corner.y + 0.5 - box.top};
        }
        coverage_->measure(outline, box.width, box.height);
        const float brightness = discs_[i].brightness;
        const auto bytes = static_cast<std::size_t>(bytes_per_pixel(into.shape.format));
        coverage_->each([&](int x, int y, float covered) {
            std::uint8_t* pixel = into.row(box.top + y) + static_cast<std::size_t>(box.left + x) * bytes;
            const float mixed = covered * brightness + (1 - covered) * *pixel;
            std::fill_n(pixel, bytes, static_cast<std::uint8_t>(mixed + 0.5f));
        });
    }
}

}  // namespace groundstate::simulated
