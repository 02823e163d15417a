// Operator, camera and visual servoing.
#include "hooks.hpp"

namespace controller_system {

using namespace groundstate;

namespace {

// Keeps what fits into the reserved memory.
template <class T>
void record(std::vector<T>& recording, const T& entry) {
    if (recording.size() < recording.capacity()) {
        recording.push_back(entry);
    }
}

}  // namespace

GoalSender::GoalSender(Now now, const Cell& cell, std::vector<Goal> goals)
    : now_{std::move(now)}, goals_{std::move(goals)} {
    for (const Goal& goal : goals_) {
        targets_.push_back({.desired = cell.view(cell.settings().target.pose * goal.camera),
                            .number = static_cast<std::int64_t>(targets_.size()) + 1});
    }
}

bool GoalSender::plan(const Cycle&, const In&, Out& out) {
    const std::int64_t now_ns = now_();
    if (origin_ns_ < 0) {
        origin_ns_ = now_ns;
    }
    if (next_ == goals_.size() || now_ns - origin_ns_ < goals_[next_].at_ns) {
        return false;
    }
    out.targets = targets_[next_++];
    return true;
}

bool ImageGrabber::grab(const Cycle& cycle, const In&, Out& out) {
    CameraToVs& image = out.camera_to_vs;
    const groundstate::Grab grabbed = grab_(image.frame.view(), cycle.watchdog);
    if (!grabbed) {
        ++without_image_;
        return false;
    }
    image.captured_ns = grabbed.stamp_ns;
    image.number = grabbed.sequence;
    return true;
}

ServoingByImages::ServoingByImages(Now now, const ServoingSettings& settings, std::size_t sights)
    : now_{std::move(now)}, settings_{settings}, tracker_{640, 480, settings.tracker}, kept_(settings.keep_after_ns.size() * settings.targets_kept) {
    sights_.reserve(sights);
}

void ServoingByImages::keep(const CameraToVs& image) {
    if (keeping_ < kept_.size() && keeping_next_ < settings_.keep_after_ns.size() &&
        image.captured_ns - target_came_ns_ >= settings_.keep_after_ns[keeping_next_]) {
        *kept_[keeping_].frame = image.frame;
        kept_[keeping_].captured_ns = image.captured_ns;
        kept_[keeping_].target = target_;
        kept_[keeping_].tracked = tracker_.present();
        ++keeping_;
        ++keeping_next_;
    }
}

void ServoingByImages::aim(const Targets& target) {
    target_ = target.number;
    target_came_ns_ = now_();
    keeping_next_ = 0;
    desired_ = target.desired;
    servo::Pixels expected;
    for (std::size_t i = 0; i < servo::points; ++i) {
        expected[i] = settings_.lens.pixel(desired_.seen[i]);
    }
    if (!tracker_.present()) {
        tracker_.expect(expected);
    }
}

void ServoingByImages::before_sensors(const Cycle&, const In& in) {
    if (in.targets && in.targets.fresh) {
        aim(*in.targets);
    }
    sight_ = {};
    if (!in.camera_to_vs || !in.camera_to_vs.fresh || target_ == 0) {
        return;
    }
    const CameraToVs& image = *in.camera_to_vs;
    sight_ = {.at_ns = now_(), .captured_ns = image.captured_ns, .target = target_};
    sight_.tracked = tracker_.look(image.frame.view(), image.captured_ns);
    keep(image);
    if (sight_.tracked) {
        servo::View present{servo::normalised(settings_.lens, sight_.tracked.pixels), {}};
        present.depths = servo::depths_by_area(present.seen, desired_);
        sight_.command = servo::control(settings_.law, present, desired_);
    }
}

bool ServoingByImages::set_point(const Cycle& cycle, const In& in, Out& out) {
    VisualServoingMachine::set_point(cycle, in, out);
    sight_.mode = out.panel.value();
    if (sight_.mode == ServoMode::LOST && tracker_.present()) {
        tracker_.give_up();
    }
    for (std::size_t i = 0; i < 6; ++i) {
        out.vs_to_robot.twist[i] = sight_.command.twist[static_cast<Eigen::Index>(i)];
    }
    out.vs_to_robot.error = sight_.command.error;
    out.vs_to_robot.captured_ns = sight_.captured_ns;
    if (sight_.target != 0) {
        record(sights_, sight_);
    }
    return out.guiding.value();
}

}  // namespace controller_system
