// What the components of the tracking head do beside what their machines decide: pictures, directions, motion.
//
// Whether the object is searched, tracked or lost, and whether the head follows it, is in Tracker.asm and Head.asm. Here the
// tracker turns what it sees into a direction, with the head's angles at the instant of the image, and filters it: a constant
// velocity between images (alpha-beta filter, Kalata 1984). The head follows where the object is by now.
#pragma once

#include <functional>

#include <groundstate/frame_source.hpp>
#include <groundstate/kinematics/follower.hpp>
#include <groundstate/vision/disc_detector.hpp>

#include "generated/tracking_system_machines.hpp"
#include "scenery.hpp"

namespace tracking_system {

using Now = std::function<std::int64_t()>;

class ImageGrabber final : public Camera {
  public:
    using Grab = std::function<groundstate::Grab(groundstate::FrameView, groundstate::Watchdog&)>;
    explicit ImageGrabber(Grab grab) : grab_{std::move(grab)} {}
    bool grab(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Grab grab_;
};

struct TrackerSettings {
    double alpha = 0.6;  ///< of the deviation in position
    double beta = 0.2;   ///< of the deviation, in velocity
};

/// The machine says where to look; here is what is seen there.
class ObjectTracker final : public TrackerMachine {
  public:
    explicit ObjectTracker(const TrackerSettings& settings = {});
    void before_sensors(const Cycle& cycle, const In& in) override;
    bool found(const Cycle&) override { return disc_.has_value(); }
    bool locate(const Cycle& cycle, const In& in, Out& out) override;

    long searches() const noexcept { return searches_; }
    long unseen() const noexcept { return unseen_; }

  private:
    bool searches_whole() const noexcept { return machine().mode() == ::tracker::Mode::SEARCHING; }
    std::optional<groundstate::vision::Disc> find(groundstate::ConstFrameView image, const Angles& head);

    TrackerSettings settings_;
    groundstate::vision::DiscDetector detector_;
    std::optional<groundstate::vision::Disc> disc_{};
    Track track_{};
    double radius_ = 0;
    long searches_ = 0;
    long unseen_ = 0;
};

struct HeadSettings {
    double pull = 12;  ///< 1/s: how fast it catches up
    double most_velocity = 2.5;
    double most_acceleration = 25;
};

/// The machine says whether the head follows; here is how.
class HeadController final : public HeadMachine {
  public:
    HeadController(Now now, const HeadSettings& settings = {}) : now_{std::move(now)}, settings_{settings} {}
    bool follow(const Cycle& cycle, const In& in, Out& out) override;

    bool holding() const noexcept { return holding_; }

  private:
    Now now_;
    HeadSettings settings_;
    Angles position_{};
    Angles velocity_{};
    std::int64_t last_ns_ = -1;
    bool holding_ = true;
};

class HeadDrives final : public Motor {
  public:
    using Command = std::function<void(std::int64_t now_ns, const Angles& velocity)>;
    HeadDrives(Now now, Command command) : now_{std::move(now)}, command_{std::move(command)} {}
    bool drive(const Cycle& cycle, const In& in, Out& out) override;
    /// The joints stand: nobody leads them any more.
    void safe_stop() noexcept override;

  private:
    Now now_;
    Command command_;
    groundstate::kinematics::Follower<2> follower_{{.stiffness = 30, .braking = 20}};
};

class HeadEncoders final : public Encoder {
  public:
    using Read = std::function<Angles(std::int64_t now_ns)>;
    HeadEncoders(Now now, Read read) : now_{std::move(now)}, read_{std::move(read)} {}
    bool acquire(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    Read read_;
};

/// Keeps what it is told, as a screen would show it.
class SightingList final : public Display {
  public:
    explicit SightingList(std::size_t most) { shown_.reserve(most); }
    bool show(const Cycle& cycle, const In& in, Out& out) override;

    const std::vector<Sightings>& shown() const noexcept { return shown_; }

  private:
    std::vector<Sightings> shown_{};
};

}  // namespace tracking_system
