// A camera that takes pictures of a scene from where a robot's arm holds it, by any clock.
//
// In virtual time a run is the same each time, byte by byte: what a frame shows depends on the pose at the instant it
// was taken, and on the seed; which frame a grab gives depends on the clock alone. A grab gives the newest frame that
// has arrived; older ones that nobody fetched are lost, and counted, as with a driver that keeps the latest.
#pragma once

#include <functional>

#include <groundstate/frame_source.hpp>

#include "lens.hpp"

namespace groundstate::simulated {

/// The pose at an instant of the clock. It is asked by the thread that grabs, with the instant at which the frame was
/// taken, up to a readout and a delay ago; it must not throw.
using PoseAt = std::function<Pose(std::int64_t taken_ns)>;

struct Settings {
    FrameShape shape{640, 480, PixelFormat::mono8};
    std::int64_t period_ns = 10'000'000;
    std::int64_t readout_ns = 0;  ///< from when a frame is taken to when it has arrived
    Faults faults{};
};

/// A FrameSource that draws. The first frame is taken when it is opened.
template <Clock C>
class Camera {
  public:
    /// Fails with `refused` if the settings make no camera: no pixels, no period, times below 0.
    /// Who: the owner. Blocks: no. Allocates: yes.
    static Opened<Camera> open(C& clock, Scene scene, PoseAt pose_at, const Settings& settings = {}) {
        if (settings.shape.width <= 0 || settings.shape.height <= 0) {
            return OpenFailure{OpenError::refused, "a simulated camera needs a width and a height above 0"};
        }
        if (settings.period_ns <= 0 || settings.readout_ns < 0 || settings.faults.slow_ns < 0) {
            return OpenFailure{OpenError::refused, "a simulated camera needs a period above 0, and no time below 0"};
        }
        if (!pose_at) {
            return OpenFailure{OpenError::refused, "a simulated camera needs to know where it is"};
        }
        return std::unique_ptr<Camera>{new Camera{clock, std::move(scene), std::move(pose_at), settings}};
    }

    Camera(const Camera&) = delete;
    Camera& operator=(const Camera&) = delete;

    FrameShape shape() const noexcept { return settings_.shape; }

    /// Who: the one that grabs. Blocks: until a frame arrives, ≤ budget. Allocates: if there is blur, within OpenCV.
    /// Worst case: to draw a picture; and a look at each frame that was taken since the grab before.
    Grab grab(FrameView into, Watchdog& watchdog) noexcept {
        if (into.shape != settings_.shape || into.stride_bytes < into.shape.row_bytes()) {
            return ledger_.tell({.outcome = Outcome::other_shape});
        }
        const std::uint64_t frame = await(watchdog);
        if (frame == 0) {
            if (over_) {
                return ledger_.tell({exposures_.unplugs() ? Outcome::disconnected : Outcome::end_of_stream});
            }
            watchdog.skip();
            return ledger_.tell({.outcome = Outcome::timeout});
        }
        next_ = frame + 1;
        const Faults& faults = settings_.faults;
        if (falls(faults.damaged, faults.seed, Lot::damaged, frame)) {
            into.shape.height /= 2;
            draw(frame, into);
            return ledger_.tell({.outcome = Outcome::damaged});
        }
        draw(frame, into);
        return ledger_.tell({Outcome::frame, frame, exposures_.taken_ns(frame)});
    }

    /// Who: everybody. Blocks: no.
    FrameAccount account() const noexcept { return ledger_.account(); }

    /// What is in front of the camera, and what of it is covered in a frame: to judge what was made of a picture.
    const Scene& scene() const noexcept { return scene_; }
    const Lens& lens() const noexcept { return lens_; }

  private:
    Camera(C& clock, Scene scene, PoseAt pose_at, const Settings& settings)
        : clock_{clock},
          scene_{std::move(scene)},
          pose_at_{std::move(pose_at)},
          settings_{settings},
          lens_{settings.faults, settings.shape},
          exposures_{clock.now_ns(), settings.period_ns, settings.readout_ns, settings.faults} {
        scene_.prepare(settings.shape);
    }

    // The newest frame that has not been given, or 0: the budget is used up, or there will be no more.
    std::uint64_t await(Watchdog& watchdog) noexcept {
        const std::int64_t start_ns = clock_.now_ns();
        const std::int64_t until_ns = later_ns(start_ns, watchdog.left_ns());
        std::int64_t now_ns = start_ns;
        std::uint64_t frame = 0;
        while (!over_ && (frame = exposures_.newest(next_, now_ns)) == 0) {
            next_ = exposures_.first_open(next_, now_ns);
            const std::int64_t end_ns = exposures_.end_ns(next_);
            over_ = end_ns <= now_ns;
            if (over_ || now_ns >= until_ns) {
                break;
            }
            clock_.sleep_until_ns(exposures_.next_ns(next_, std::min(end_ns, until_ns)));
            now_ns = clock_.now_ns();
        }
        if (now_ns > start_ns) {
            watchdog.waited(now_ns - start_ns);
        }
        return frame;
    }

    void draw(std::uint64_t frame, FrameView into) noexcept {
        const Pose pose = pose_at_(exposures_.taken_ns(frame));
        scene_.draw(pose, into);
        lens_.spoil(frame, scene_, pose, into);
    }

    C& clock_;
    Scene scene_;
    PoseAt pose_at_;
    Settings settings_;
    Lens lens_;
    Exposures exposures_;
    FrameLedger ledger_{};
    std::uint64_t next_ = 1;
    bool over_ = false;
};

static_assert(FrameSource<Camera<MonotonicClock>>);

}  // namespace groundstate::simulated
