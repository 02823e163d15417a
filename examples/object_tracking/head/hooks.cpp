// Image to direction, direction to set-point, set-point to velocity.
#include "hooks.hpp"

#include <algorithm>

namespace tracking_system {

using namespace groundstate;

namespace {

constexpr std::int64_t never_ns = INT64_MIN / 2;  // so long ago that no set-point is fresh

double seconds(std::int64_t span_ns) { return static_cast<double>(span_ns) * 1e-9; }

Angles later(const Angles& position, const Angles& velocity, std::int64_t span_ns) {
    return {position[0] + velocity[0] * seconds(span_ns), position[1] + velocity[1] * seconds(span_ns)};
}

}  // namespace

bool ImageGrabber::grab(const Cycle& cycle, const In&, Out& out) {
    const groundstate::Grab grabbed = grab_(out.image.frame.view(), cycle.watchdog);
    out.image.captured_ns = grabbed.stamp_ns;
    return static_cast<bool>(grabbed);
}

ObjectTracker::ObjectTracker(const TrackerSettings& settings)
    : settings_{settings}, detector_{640, 480, {.dark = false}} {}

std::optional<vision::Disc> ObjectTracker::find(ConstFrameView image, const Angles& head) {
    if (!searches_whole()) {
        const servo::Pixel expected = lens.pixel(seen_from(head, track_.position));
        return detector_.near(image, expected, 1.5 * radius_ + 12);
    }
    ++searches_;
    const std::vector<vision::Disc>& found = detector_.search(image);
    return found.empty() ? std::nullopt : std::optional{found.front()};
}

void ObjectTracker::before_sensors(const Cycle&, const In& in) {
    disc_.reset();
    if (!in.image || !in.image.fresh || !in.head_angles || in.head_angles->measured_ns == never_ns) {
        return;
    }
    const std::int64_t captured_ns = in.image->captured_ns;
    const Angles head =
        later(in.head_angles->position, in.head_angles->velocity, captured_ns - in.head_angles->measured_ns);
    const std::int64_t span_ns = captured_ns - track_.at_ns;
    const bool searched = searches_whole();
    track_.position = later(track_.position, track_.velocity, searched ? 0 : span_ns);
    track_.at_ns = captured_ns;

    disc_ = find(in.image->frame.view(), head);
    if (!disc_) {
        ++unseen_;
        return;
    }
    const Angles seen = direction(head, lens.normalised(disc_->centre));
    for (std::size_t i = 0; i < 2; ++i) {
        if (searched) {
            track_.position[i] = seen[i];
            track_.velocity[i] = 0;
        } else {
            const double off = seen[i] - track_.position[i];
            track_.position[i] += settings_.alpha * off;
            track_.velocity[i] += settings_.beta * off / std::max(1e-3, seconds(span_ns));
        }
    }
    radius_ = std::sqrt(disc_->area / M_PI);
}

bool ObjectTracker::locate(const Cycle& cycle, const In& in, Out& out) {
    const bool decided = TrackerMachine::locate(cycle, in, out);
    out.track = track_;
    out.sightings = {.captured_ns = in.image ? in.image->captured_ns : never_ns, .seen = disc_.has_value()};
    if (disc_) {
        out.sightings.off_centre = std::hypot(disc_->centre.u - lens.cx, disc_->centre.v - lens.cy);
    }
    return decided;
}

// Whether it is seen is read before where it is, so what is followed has a place.
bool HeadController::follow(const Cycle& cycle, const In& in, Out& out) {
    const bool decided = HeadMachine::follow(cycle, in, out);
    holding_ = out.aim.value == Pursuit::HOLDING;
    if (!in.encoder_to_head) {
        out.head_to_motor = {.set_ns = never_ns};
        out.head_angles = {.measured_ns = never_ns};
        return decided;
    }
    const std::int64_t now_ns = now_();
    const double dt = last_ns_ < 0 ? 0 : seconds(now_ns - last_ns_);
    if (last_ns_ < 0) {
        position_ = in.encoder_to_head->position;
    }
    last_ns_ = now_ns;
    for (std::size_t i = 0; i < 2; ++i) {
        double wanted = 0;
        if (!holding_ && in.track) {
            const double there = in.track->position[i] + in.track->velocity[i] * seconds(now_ns - in.track->at_ns);
            wanted = in.track->velocity[i] + settings_.pull * (there - position_[i]);
            wanted = std::clamp(wanted, -settings_.most_velocity, settings_.most_velocity);
        }
        const double most = settings_.most_acceleration * dt;
        velocity_[i] += std::clamp(wanted - velocity_[i], -most, most);
        position_[i] += velocity_[i] * dt;
    }
    out.head_to_motor = {position_, velocity_, now_ns};
    out.head_angles = {in.encoder_to_head->position, velocity_, in.encoder_to_head->measured_ns};
    return decided;
}

void HeadDrives::safe_stop() noexcept { command_(now_(), {}); }

bool HeadDrives::drive(const Cycle&, const In& in, Out&) {
    const std::int64_t now_ns = now_();
    follower_.begin(now_ns);
    Eigen::Vector2d velocity;
    if (in.encoder_to_motor && follower_.is_fresh(in.encoder_to_motor->measured_ns) && in.head_to_motor &&
        follower_.is_fresh(in.head_to_motor->set_ns)) {
        const HeadToMotor& set = *in.head_to_motor;
        velocity = follower_.follow(Eigen::Vector2d{set.position.data()}, Eigen::Vector2d{set.velocity.data()}, set.set_ns,
                                    Eigen::Vector2d{in.encoder_to_motor->position.data()},
                                    in.encoder_to_motor->measured_ns);
    } else {
        velocity = follower_.brake();
    }
    command_(now_ns, {velocity[0], velocity[1]});
    return true;
}

bool HeadEncoders::acquire(const Cycle&, const In&, Out& out) {
    const std::int64_t now_ns = now_();
    const Angles position = read_(now_ns);
    out.encoder_to_head = {position, now_ns};
    out.encoder_to_motor = {position, now_ns};
    return true;
}

bool SightingList::show(const Cycle&, const In& in, Out&) {
    if (in.sightings && in.sightings.fresh && shown_.size() < shown_.capacity()) {
        shown_.push_back(*in.sightings);
    }
    return true;
}

}  // namespace tracking_system
