// Builds head, object and tasks, and runs them.
#include "closed_loop.hpp"

#include <algorithm>

namespace tracking_system {

using namespace groundstate;

namespace {

// Looks on: how far the object is from the middle at every image, seen by nobody but the judge.
class Watched final : public Encoder {
  public:
    Watched(Now now, Scenery& scenery, HeadEncoders& encoders, std::vector<double>& into)
        : now_{std::move(now)}, scenery_{scenery}, encoders_{encoders}, into_{into} {}
    bool acquire(const Cycle& cycle, const In& in, Out& out) override {
        if (cycle.number % 20 == 0) {
            into_.push_back(scenery_.off_centre(now_()));
        }
        return encoders_.acquire(cycle, in, out);
    }

  private:
    Now now_;
    Scenery& scenery_;
    HeadEncoders& encoders_;
    std::vector<double>& into_;
};

}  // namespace

double Loop::worst(double from_s, double to_s) const {
    double result = 0;
    for (std::size_t i = 0; i < off_centre.size(); ++i) {
        const double at_s = static_cast<double>(i) * 0.01;
        result = at_s >= from_s && at_s <= to_s ? std::max(result, off_centre[i]) : result;
    }
    return result;
}

namespace {

template <Clock C>
Loop run(const LoopSettings& settings, C& clock) {
    Loop loop;
    loop.origin_ns = clock.now_ns();
    const std::int64_t span_ns = settings.run.span_ns;
    const Now now = [&clock] { return clock.now_ns(); };
    Scenery scenery{settings.run.seed};
    auto eye = simulated::Camera<C>::open(
        clock, scenery.scene(), [&](std::int64_t at_ns) { return scenery.camera_from_object(at_ns); },
        {.faults = settings.faults});
    ImageGrabber camera{[&](FrameView into, Watchdog& watchdog) { return eye->grab(into, watchdog); }};
    ObjectTracker tracker;
    HeadController head{now};
    HeadDrives motor{now, [&](std::int64_t at_ns, const Angles& velocity) { scenery.drive(at_ns, velocity); }};
    HeadEncoders encoders{now, [&](std::int64_t at_ns) { return scenery.measured(at_ns); }};
    loop.off_centre.reserve(static_cast<std::size_t>(span_ns / 10'000'000 + 10));
    Watched encoder{now, scenery, encoders, loop.off_centre};
    SightingList display{static_cast<std::size_t>(span_ns / 5'000'000)};
    loop.account = closed_loop::run_tasks<System>(
        clock, Hooks{.camera = camera, .tracker = tracker, .head = head, .motor = motor, .encoder = encoder, .display = display},
        settings.run);
    loop.shown = display.shown();
    loop.searches = tracker.searches();
    loop.unseen = tracker.unseen();
    loop.holding = head.holding();
    return loop;
}

}  // namespace

Loop run(const LoopSettings& settings) {
    return closed_loop::on_its_clock<System>(settings.run, [&](auto& clock) { return run(settings, clock); });
}

}  // namespace tracking_system
