// ViSP's servo task on four points, behind numbers: its headers are C++17 and no later.
#pragma once

#include <array>
#include <memory>

/// With its own matrices, pseudo-inverse and adaptive gain.
class VispLaw {
  public:
    /// x, y and depth of each point.
    using Points = std::array<std::array<double, 3>, 4>;
    enum class Matrix { current, desired, mean };
    struct Gain {
        double at_zero, at_infinity, slope_at_zero;
    };

    VispLaw(Matrix matrix, const Gain& gain, const Points& desired);
    ~VispLaw();
    std::array<double, 6> twist(const Points& present);

  private:
    struct Task;
    std::unique_ptr<Task> task_;
};
