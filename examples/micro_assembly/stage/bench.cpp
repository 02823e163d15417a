// Time, force and pictures of the bench.
#include "bench.hpp"

#include <algorithm>

namespace assembly_system {

using namespace groundstate;

Bench::Bench(const BenchSettings& settings, std::int64_t origin_ns)
    : settings_{settings}, origin_ns_{origin_ns}, random_{settings.seed} {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const bool turns = i == 2;
        axes_[i] = {{.lag_s = 0.002,
                     .most_acceleration = turns ? 20.0 : 0.5,
                     .encoder_step = turns ? 1e-5 : 1e-8,
                     .encoder_noise = 0.5},
                    0};
    }
}

void Bench::pass_until(std::int64_t now_ns) {
    const std::int64_t now = now_ns / step_ns;
    step_ = step_ < 0 ? now : step_;
    for (; step_ < now; ++step_) {
        for (plant::Joint& axis : axes_) {
            axis.pass(static_cast<double>(step_ns) * 1e-9);
        }
        const double pushed = std::max(0.0, axes_[3].position() - settings_.contact_z) * settings_.spring;
        worst_force_ = std::max(worst_force_, pushed);
    }
}

Axes Bench::measured(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    Axes result{};
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        result[i] = axes_[i].measured(random_);
    }
    return result;
}

void Bench::drive(std::int64_t now_ns, const Axes& velocity) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        axes_[i].command(velocity[i]);
    }
}

double Bench::force(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    const double pushed = std::max(0.0, axes_[3].position() - settings_.contact_z) * settings_.spring;
    return pushed + settings_.force_noise * random_.normal();
}

Axes Bench::position(std::int64_t now_ns) {
    const std::lock_guard guard{mutex_};
    pass_until(now_ns);
    return {axes_[0].position(), axes_[1].position(), axes_[2].position(), axes_[3].position()};
}

bool Bench::draw(std::int64_t now_ns, FrameView into) {
    if (settings_.unplugged_s > 0 && static_cast<double>(now_ns - origin_ns_) * 1e-9 > settings_.unplugged_s) {
        return false;
    }
    const Axes part = position(now_ns);
    std::vector<simulated::Disc> discs;
    // A mark at (u, v) of something that lies at (x, y), turned.
    const auto mark = [&](double x, double y, double turn, double u, double v, double radius) {
        discs.push_back({.centre = {x + std::cos(turn) * u - std::sin(turn) * v,
                                    y + std::sin(turn) * u + std::cos(turn) * v, 0},
                         .radius = radius});
    };
    for (const double side : {-1.0, 1.0}) {
        mark(settings_.x, settings_.y, settings_.turn, side * 3.4e-4, 0, 4e-5);
        mark(part[0], part[1], part[2], 0, side * 2.4e-4, 2.4e-5);
    }
    // A lens without perspective, as a camera far away: a pixel is 2 micrometres in the plane of the marks.
    simulated::Scene scene{std::move(discs), {.fx = 1 / metres_a_pixel, .fy = 1 / metres_a_pixel, .cx = 319.5, .cy = 239.5}};
    scene.prepare(into.shape);
    scene.draw({.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .position = {0, 0, -1}}, into);
    if (settings_.noise > 0) {
        const std::lock_guard guard{mutex_};
        for (int v = 0; v < into.shape.height; ++v) {
            for (int u = 0; u < into.shape.width; ++u) {
                std::uint8_t& pixel = into.row(v)[u];
                pixel = static_cast<std::uint8_t>(std::clamp(pixel + settings_.noise * random_.normal(), 0.0, 255.0));
            }
        }
    }
    return true;
}

}  // namespace assembly_system
