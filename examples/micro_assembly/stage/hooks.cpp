// Marks to corrections, corrections to axes, states to recipes.
#include "hooks.hpp"

#include <algorithm>
#include <optional>

namespace assembly_system {

using namespace groundstate;

namespace {

constexpr int enough_images = 5;
constexpr double quarter = M_PI / 2;

Lying lying(const vision::Disc& one, const vision::Disc& other) {
    const double u = other.centre.u - one.centre.u;
    const double v = other.centre.v - one.centre.v;
    return {((one.centre.u + other.centre.u) / 2 - 319.5) * metres_a_pixel,
            ((one.centre.v + other.centre.v) / 2 - 239.5) * metres_a_pixel, std::atan2(v, u)};
}

// The same line through two marks, whichever comes first: within a quarter of a turn around 0.
double of_line(double turn) { return turn - M_PI * std::round(turn / M_PI); }

}  // namespace

bool MicroscopeImages::grab(const Cycle&, const In&, Out& out) {
    out.image.captured_ns = now_();
    return bench_.draw(out.image.captured_ns, out.image.frame.view());
}

bool MarkAligner::compare(const Cycle&, const In& in, Out& out) {
    if (in.recipe && in.recipe.fresh) {
        recipe_ = *in.recipe;
        aligned_images_ = 0;
    }
    if (!in.image || !in.image.fresh) {
        return false;
    }
    const std::vector<vision::Disc>& marks = detector_.search(in.image->frame.view());
    // Two large ones, two small ones, the largest first.
    if (marks.size() < 4 || marks[1].area < 1.5 * marks[2].area || marks[3].area * 1.5 < marks[2].area) {
        aligned_images_ = 0;
        return false;
    }
    const Lying substrate = lying(marks[0], marks[1]);
    const Lying part = lying(marks[2], marks[3]);
    Correction& correction = out.correction;
    correction = {.number = recipe_.number,
                  .work = recipe_.work,
                  .x = substrate.x - part.x,
                  .y = substrate.y - part.y,
                  .turn = of_line(substrate.turn - part.turn + quarter),
                  .captured_ns = in.image->captured_ns};
    const bool aligned = std::hypot(correction.x, correction.y) < recipe_.tolerance &&
                         std::abs(correction.turn) < recipe_.turn_tolerance;
    aligned_images_ = aligned ? aligned_images_ + 1 : 0;
    correction.aligned_images = aligned_images_;
    return true;
}

bool ForceSensor::feel(const Cycle&, const In&, Out& out) {
    const std::int64_t now_ns = now_();
    out.contact = {bench_.force(now_ns), now_ns};
    return true;
}

void StageMover::work(const In& in, std::int64_t now_ns, double dt) {
    const double force = in.contact ? in.contact->force : 0;
    state_.overload = state_.overload || force > settings_.most_force;
    if (state_.overload) {
        state_.work = Work::retract;
        set_[3] = std::max(0.0, set_[3] - settings_.retracting * dt);
        state_.retracted = set_[3] == 0;
        return;
    }
    if (!in.correction || now_ns - in.correction->captured_ns > settings_.most_age_ns) {
        state_.work = Work::wait;
        return;
    }
    const Correction& correction = *in.correction;
    state_.work = correction.work;
    state_.aligned_images = correction.aligned_images;
    if (correction.work == Work::align && in.correction.fresh) {
        // From where the axes are, not from where they were to be: an axis that is still on its way is not sent farther.
        const Axes& position = in.scale->position;
        set_[0] = position[0] + settings_.gain * correction.x;
        set_[1] = position[1] + settings_.gain * correction.y;
        set_[2] = position[2] + settings_.gain * correction.turn;
    }
    const bool feels = in.contact && now_ns - in.contact->at_ns <= settings_.force_age_ns;
    if (correction.work == Work::lower && feels && !state_.placed) {
        state_.placed = force > settings_.contact;
        set_[3] += state_.placed ? 0 : settings_.lowering * dt;
    }
}

bool StageMover::approach(const Cycle&, const In& in, Out& out) {
    if (!in.scale) {
        return false;
    }
    const std::int64_t now_ns = now_();
    const double dt = last_ns_ < 0 ? 0 : static_cast<double>(now_ns - last_ns_) * 1e-9;
    if (last_ns_ < 0) {
        set_ = in.scale->position;
    }
    last_ns_ = now_ns;
    work(in, now_ns, dt);
    state_.force = in.contact ? in.contact->force : 0;
    state_.at_ns = now_ns;
    out.axis_order = {set_, now_ns};
    out.state = state_;
    if (states_.size() < states_.capacity()) {
        states_.push_back(state_);
    }
    return true;
}

// The axes measure themselves, faster than any channel could.
void PiezoAxes::safe_stop() noexcept { bench_.drive(now_(), {}); }

bool PiezoAxes::drive(const Cycle&, const In& in, Out&) {
    const std::int64_t now_ns = now_();
    Axes velocity{};
    if (in.axis_order && now_ns - in.axis_order->set_ns <= 20'000'000) {
        const Axes position = bench_.measured(now_ns);
        for (std::size_t i = 0; i < velocity.size(); ++i) {
            const double most = i == 2 ? 0.2 : 5e-3;  // it can stop from there
            velocity[i] = std::clamp(80 * (in.axis_order->position[i] - position[i]), -most, most);
        }
    }
    bench_.drive(now_ns, velocity);
    return true;
}

bool LinearScales::acquire(const Cycle&, const In&, Out& out) {
    const std::int64_t now_ns = now_();
    out.scale = {bench_.measured(now_ns), now_ns};
    return true;
}

bool AssemblySupervisor::order(Work work, Out& out) {
    work_ = work;
    out.recipe = {.number = ++number_, .work = work};
    return true;
}

bool AssemblySupervisor::decide(const Cycle&, const In& in, Out& out) {
    if (!in.state || done_ || failed_) {
        return false;
    }
    if (in.state->overload) {
        failed_ = in.state->retracted;
        return false;
    }
    switch (work_) {
        case Work::wait: return order(Work::align, out);
        case Work::align:
            return in.state->work == Work::align && in.state->aligned_images >= enough_images && order(Work::lower, out);
        case Work::lower: done_ = in.state->placed; break;
        case Work::retract: break;
    }
    return false;
}

}  // namespace assembly_system
