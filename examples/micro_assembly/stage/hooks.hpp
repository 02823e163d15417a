// What the components of the assembly do.
//
// The supervisor orders: align, and when enough images in a row are aligned, lower; when the part lies, it is done. The
// aligner compares the marks; the stage follows its corrections, lowers until it feels the contact, and retracts by itself
// when the force is too large. Without fresh corrections it neither aligns nor lowers: it stands.
#pragma once

#include <functional>

#include <groundstate/vision/disc_detector.hpp>

#include "bench.hpp"
#include "generated/assembly_system.hpp"

namespace assembly_system {

using Now = std::function<std::int64_t()>;

class MicroscopeImages final : public Microscope {
  public:
    MicroscopeImages(Now now, Bench& bench) : now_{std::move(now)}, bench_{bench} {}
    bool grab(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    Bench& bench_;
};

/// Where something with two marks lies, in the image.
struct Lying {
    double x = 0;  ///< m from the middle of the image
    double y = 0;
    double turn = 0;  ///< of the line through its marks, within half a turn
};

class MarkAligner final : public Aligner {
  public:
    bool compare(const Cycle& cycle, const In& in, Out& out) override;

  private:
    groundstate::vision::DiscDetector detector_{640, 480, {.dark = false, .least_area = 60}};
    Recipe recipe_{};
    int aligned_images_ = 0;
};

class ForceSensor final : public Force {
  public:
    ForceSensor(Now now, Bench& bench) : now_{std::move(now)}, bench_{bench} {}
    bool feel(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    Bench& bench_;
};

struct StageSettings {
    double gain = 0.5;                       ///< of a correction
    double lowering = 2e-4;                  ///< m/s
    double retracting = 1e-3;                ///< m/s
    double contact = 0.02;                   ///< N: it lies
    double most_force = 0.1;                 ///< N: then it retracts
    std::int64_t most_age_ns = 100'000'000;  ///< of a correction
    std::int64_t force_age_ns = 5'000'000;   ///< of a contact, while it lowers
};

class StageMover final : public Stage {
  public:
    StageMover(Now now, const StageSettings& settings, std::size_t states) : now_{std::move(now)}, settings_{settings} {
        states_.reserve(states);
    }
    bool approach(const Cycle& cycle, const In& in, Out& out) override;

    const std::vector<State>& states() const noexcept { return states_; }

  private:
    void work(const In& in, std::int64_t now_ns, double dt);

    Now now_;
    StageSettings settings_;
    Axes set_{};
    State state_{};
    std::vector<State> states_{};
    std::int64_t last_ns_ = -1;
};

class PiezoAxes final : public Piezo {
  public:
    PiezoAxes(Now now, Bench& bench) : now_{std::move(now)}, bench_{bench} {}
    bool drive(const Cycle& cycle, const In& in, Out& out) override;
    /// The axes stand: nobody leads them any more.
    void safe_stop() noexcept override;

  private:
    Now now_;
    Bench& bench_;
};

class LinearScales final : public ScalesReader {
  public:
    LinearScales(Now now, Bench& bench) : now_{std::move(now)}, bench_{bench} {}
    bool acquire(const Cycle& cycle, const In& in, Out& out) override;

  private:
    Now now_;
    Bench& bench_;
};

class AssemblySupervisor final : public Supervisor {
  public:
    bool decide(const Cycle& cycle, const In& in, Out& out) override;

    Work work() const noexcept { return work_; }
    bool is_done() const noexcept { return done_; }
    bool failed() const noexcept { return failed_; }

  private:
    bool order(Work work, Out& out);

    Work work_ = Work::wait;
    std::int64_t number_ = 0;
    bool done_ = false;
    bool failed_ = false;
};

}  // namespace assembly_system
