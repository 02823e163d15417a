// What the components of the assembly do beside what their machines decide: pictures, forces, motion.
//
// What is ordered when, whether the part lies right, and what the axes are led to do is in Supervisor.asm, Aligner.asm and
// Stage.asm. Here the marks are compared, forces are told apart by their bounds, and the axes are led.
#pragma once

#include <functional>

#include <groundstate/vision/disc_detector.hpp>

#include "bench.hpp"
#include "generated/assembly_system_machines.hpp"

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

struct AlignerSettings {
    double tolerance = 5e-7;       ///< m
    double turn_tolerance = 1e-3;  ///< rad
};

/// The machine says what is told to the stage; here is what an image shows.
class MarkAligner final : public AlignerMachine {
  public:
    void before_sensors(const Cycle& cycle, const In& in) override;
    bool marked(const Cycle&) override { return marked_; }
    bool crossed(const Cycle&) override { return crossed_; }
    bool compare(const Cycle& cycle, const In& in, Out& out) override;

  private:
    AlignerSettings settings_{};
    groundstate::vision::DiscDetector detector_{640, 480, {.dark = false, .least_area = 60}};
    Correction correction_{};
    bool marked_ = false;
    bool crossed_ = false;
};

struct ForceSettings {
    double contact = 0.02;  ///< N: it lies
    double most = 0.1;      ///< N: more than the part bears
};

/// What was felt, and when.
struct Felt {
    double force = 0;
    std::int64_t at_ns = 0;
};

class ForceSensor final : public Force {
  public:
    ForceSensor(Now now, Bench& bench, const ForceSettings& settings, std::size_t felt)
        : now_{std::move(now)}, bench_{bench}, settings_{settings} {
        felt_.reserve(felt);
    }
    bool feel(const Cycle& cycle, const In& in, Out& out) override;

    const std::vector<Felt>& felt() const noexcept { return felt_; }

  private:
    Now now_;
    Bench& bench_;
    ForceSettings settings_;
    std::vector<Felt> felt_{};
};

struct StageSettings {
    double gain = 0.5;         ///< of a correction
    double lowering = 2e-4;    ///< m/s
    double retracting = 1e-3;  ///< m/s
};

/// How far the stage was, and when.
struct Stood {
    Progress state{};
    std::int64_t at_ns = 0;
};

/// The machine says what the axes are led to do; here is where that leads them.
class StageMover final : public StageMachine {
  public:
    StageMover(Now now, const StageSettings& settings, std::size_t states) : now_{std::move(now)}, settings_{settings} {
        states_.reserve(states);
    }
    bool approach(const Cycle& cycle, const In& in, Out& out) override;
    /// As far as it has led them.
    bool is_up(const Cycle&) override { return set_[3] <= 0; }
    void motion(const Cycle&, Motion) override {}

    const std::vector<Stood>& states() const noexcept { return states_; }

  private:
    void lead(Motion motion, const In& in, double dt);

    Now now_;
    StageSettings settings_;
    Axes set_{};
    std::vector<Stood> states_{};
    std::int64_t last_ns_ = -1;
    std::int64_t followed_ns_ = -1;  ///< when the image was taken whose correction was followed last
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

/// It does what its machine decides.
class AssemblySupervisor final : public SupervisorMachine {
  public:
    bool is_done() const { return machine().ending() == ::supervisor::Ending::DONE; }
    bool failed() const { return machine().ending() == ::supervisor::Ending::FAILED; }
};

}  // namespace assembly_system
