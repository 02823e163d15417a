// A six-joint arm with the camera in its hand: where the camera is, and how it moves when the joints move.
//
// The arm is a chain of Denavit-Hartenberg frames and the mounting of the camera on the last one. Orocos KDL does the
// kinematics and stays behind this interface; its solvers are made once, and a call allocates nothing.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include <Eigen/Geometry>

namespace groundstate::kinematics {

inline constexpr std::size_t joints = 6;
using Joints = Eigen::Matrix<double, static_cast<int>(joints), 1>;  ///< rad, or rad/s
using Jacobian = Eigen::Matrix<double, 6, static_cast<int>(joints)>;

/// One link: turned by the joint about z, shifted along z, then shifted along and turned about x.
struct Link {
    double a = 0;      ///< m, along x
    double alpha = 0;  ///< rad, about x
    double d = 0;      ///< m, along z
    double theta = 0;  ///< rad, added to the joint's angle
};

/// What a joint can do.
struct JointLimit {
    double least = -3;          ///< rad
    double most = 3;            ///< rad
    double most_velocity = 2;   ///< rad/s
};

struct ArmModel {
    std::array<Link, joints> links{};
    std::array<JointLimit, joints> limits{};
    Eigen::Isometry3d camera_mount = Eigen::Isometry3d::Identity();  ///< the camera in the last link's frame
};

/// The arm of the examples: 0.9 m reach, a wrist whose axes meet, the camera 6 cm before the flange.
ArmModel example_arm();

/// Who: one thread, as the solvers keep intermediate values.
class Arm {
  public:
    /// Allocates: yes.
    explicit Arm(const ArmModel& model);
    ~Arm();
    Arm(const Arm&) = delete;
    Arm& operator=(const Arm&) = delete;

    const ArmModel& model() const noexcept { return model_; }

    /// The camera's frame in the base's. Blocks: no. Allocates: no.
    Eigen::Isometry3d camera(const Joints& position);

    /// The camera's twist in its own frame for each joint's unit velocity. Blocks: no. Allocates: no.
    Jacobian jacobian(const Joints& position);

  private:
    struct Solvers;
    ArmModel model_;
    std::unique_ptr<Solvers> solvers_;
};

}  // namespace groundstate::kinematics
