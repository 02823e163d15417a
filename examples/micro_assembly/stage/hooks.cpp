// Marks to corrections, corrections to axes.
#include "hooks.hpp"

#include <algorithm>

namespace assembly_system {

using namespace groundstate;

namespace {

constexpr std::int64_t never_ns = INT64_MIN / 2;  // so long ago that the axes do not follow
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

void MarkAligner::before_sensors(const Cycle&, const In& in) {
    marked_ = crossed_ = false;
    if (!in.image || !in.image.fresh) {
        return;
    }
    const std::vector<vision::Disc>& marks = detector_.search(in.image->frame.view());
    // Two large ones, two small ones, the largest first.
    if (marks.size() < 4 || marks[1].area < 1.5 * marks[2].area || marks[3].area * 1.5 < marks[2].area) {
        return;
    }
    const Lying substrate = lying(marks[0], marks[1]);
    const Lying part = lying(marks[2], marks[3]);
    correction_ = {.x = substrate.x - part.x,
                   .y = substrate.y - part.y,
                   .turn = of_line(substrate.turn - part.turn + quarter),
                   .captured_ns = in.image->captured_ns};
    marked_ = true;
    crossed_ = std::hypot(correction_.x, correction_.y) < settings_.tolerance &&
               std::abs(correction_.turn) < settings_.turn_tolerance;
}

bool MarkAligner::compare(const Cycle& cycle, const In& in, Out& out) {
    out.correction = correction_;
    return AlignerMachine::compare(cycle, in, out);
}

bool ForceSensor::feel(const Cycle&, const In&, Out& out) {
    const std::int64_t now_ns = now_();
    const double force = bench_.force(now_ns);
    out.contact.value = force > settings_.most ? Touch::OVERLOAD : force > settings_.contact ? Touch::CONTACT : Touch::FREE;
    if (felt_.size() < felt_.capacity()) {
        felt_.push_back({force, now_ns});
    }
    return true;
}

void StageMover::lead(Motion motion, const In& in, double dt) {
    switch (motion) {
        case Motion::STAND: break;
        case Motion::CORRECT:
            if (in.correction && in.correction->captured_ns != followed_ns_) {
                // From where the axes are, not from where they were to be: an axis that is still on its way is not sent farther.
                const Axes& position = in.scale->position;
                set_[0] = position[0] + settings_.gain * in.correction->x;
                set_[1] = position[1] + settings_.gain * in.correction->y;
                set_[2] = position[2] + settings_.gain * in.correction->turn;
                followed_ns_ = in.correction->captured_ns;
            }
            break;
        case Motion::DOWN: set_[3] += settings_.lowering * dt; break;
        case Motion::UP: set_[3] = std::max(0.0, set_[3] - settings_.retracting * dt); break;
    }
}

// What is to be done is read before the correction, which is thus of that image or a later one: it may have come in the cycle
// before. Each is followed once.
bool StageMover::approach(const Cycle& cycle, const In& in, Out& out) {
    const bool decided = StageMachine::approach(cycle, in, out);
    const std::int64_t now_ns = now_();
    if (!in.scale) {
        out.axis_order = {.set_ns = never_ns};
        return decided;
    }
    const double dt = last_ns_ < 0 ? 0 : static_cast<double>(now_ns - last_ns_) * 1e-9;
    if (last_ns_ < 0) {
        set_ = in.scale->position;
    }
    last_ns_ = now_ns;
    lead(out.motion.value_or(Motion::STAND), in, dt);
    out.axis_order = {set_, now_ns};
    if (states_.size() < states_.capacity()) {
        states_.push_back({out.state.value, now_ns});
    }
    return decided;
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

}  // namespace assembly_system
