// The microscope, four piezo axes, substrate and part, instead of the real ones.
//
// Each of the two carries two marks. Those of the substrate are larger and lie across those of the part; they make a cross
// when the part lies right. A pixel is 2 micrometres. Below the height of contact the substrate pushes back like a spring.
#pragma once

#include <mutex>

#include <groundstate/plant/joint.hpp>
#include <groundstate/simulated/scene.hpp>

#include "data.hpp"

namespace assembly_system {

inline constexpr double metres_a_pixel = 2e-6;

struct BenchSettings {
    double x = 0;  ///< where the substrate lies
    double y = 0;
    double turn = 0;
    double contact_z = 2e-4;
    double spring = 2e3;        ///< N/m
    double force_noise = 1e-3;  ///< N
    double noise = 0;           ///< of the image, in steps of brightness
    double unplugged_s = 0;     ///< when the microscope fails; 0: never
    std::uint64_t seed = 1;
};

class Bench {
  public:
    /// `origin_ns` is when the run begins.
    Bench(const BenchSettings& settings, std::int64_t origin_ns);

    const BenchSettings& settings() const noexcept { return settings_; }

    // Who: everybody.
    Axes measured(std::int64_t now_ns);
    void drive(std::int64_t now_ns, const Axes& velocity);
    double force(std::int64_t now_ns);
    Axes position(std::int64_t now_ns);
    double worst_force() const noexcept { return worst_force_; }

    /// False: the microscope is gone. Who: its task. Allocates: yes, as the scene changes.
    bool draw(std::int64_t now_ns, groundstate::FrameView into);

  private:
    void pass_until(std::int64_t now_ns);

    static constexpr std::int64_t step_ns = 100'000;

    BenchSettings settings_;
    std::int64_t origin_ns_;
    std::mutex mutex_{};
    std::array<groundstate::plant::Joint, 4> axes_{};
    groundstate::plant::Random random_;
    double worst_force_ = 0;
    std::int64_t step_ = -1;
};

}  // namespace assembly_system
