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

bool ServoingByImages::set_point(const Cycle&, const In& in, Out& out) {
    if (in.targets && in.targets.fresh) {
        target_ = in.targets->number;
        target_came_ns_ = now_();
        keeping_next_ = 0;
        desired_ = in.targets->desired;
        servo::Pixels expected;
        for (std::size_t i = 0; i < servo::points; ++i) {
            expected[i] = settings_.lens.pixel(desired_.seen[i]);
        }
        if (!tracker_.present()) {
            tracker_.expect(expected);
        }
    }
    if (!in.camera_to_vs || !in.camera_to_vs.fresh || target_ == 0) {
        return false;
    }
    const CameraToVs& image = *in.camera_to_vs;
    Sight sight{.at_ns = now_(), .captured_ns = image.captured_ns, .target = target_};
    sight.tracked = tracker_.look(image.frame.view(), image.captured_ns);
    keep(image);
    bool ready = false;
    if (sight.tracked) {
        servo::View present{servo::normalised(settings_.lens, sight.tracked.pixels), {}};
        present.depths = servo::depths_by_area(present.seen, desired_);
        sight.command = servo::control(settings_.law, present, desired_);
        ready = static_cast<bool>(sight.command);
        for (std::size_t i = 0; i < 6; ++i) {
            out.vs_to_robot.twist[i] = sight.command.twist[static_cast<Eigen::Index>(i)];
        }
        out.vs_to_robot.error = sight.command.error;
        out.vs_to_robot.captured_ns = image.captured_ns;
    }
    record(sights_, sight);
    return ready;
}

}  // namespace controller_system
