// The arm's kinematics with Orocos KDL.
#include "groundstate/kinematics/arm.hpp"

#include <cmath>

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

namespace groundstate::kinematics {

namespace {

KDL::Frame frame(const Eigen::Isometry3d& pose) {
    const Eigen::Matrix3d r = pose.linear();
    const Eigen::Vector3d p = pose.translation();
    return {KDL::Rotation{r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)},
            KDL::Vector{p.x(), p.y(), p.z()}};
}

KDL::Chain chain(const ArmModel& model) {
    KDL::Chain result;
    for (std::size_t i = 0; i < joints; ++i) {
        const Link& link = model.links[i];
        KDL::Frame tip = KDL::Frame::DH(link.a, link.alpha, link.d, link.theta);
        if (i + 1 == joints) {
            tip = tip * frame(model.camera_mount);
        }
        result.addSegment(KDL::Segment{KDL::Joint{KDL::Joint::RotZ}, tip});
    }
    return result;
}

}  // namespace

ArmModel example_arm() {
    constexpr double right = M_PI / 2;
    ArmModel model;
    model.links = {{{.a = 0, .alpha = right, .d = 0.40, .theta = 0},
                    {.a = 0.43, .alpha = 0, .d = 0, .theta = 0},
                    {.a = 0.02, .alpha = -right, .d = 0.15, .theta = 0},
                    {.a = 0, .alpha = right, .d = 0.43, .theta = 0},
                    {.a = 0, .alpha = -right, .d = 0, .theta = 0},
                    {.a = 0, .alpha = 0, .d = 0.08, .theta = 0}}};
    model.limits = {{{-2.8, 2.8, 1.5}, {-0.8, 3.6, 1.5}, {-3.9, 1.0, 1.5}, {-3.0, 3.0, 2.5}, {-2.1, 2.1, 2.5}, {-4.6, 4.6, 3.0}}};
    model.camera_mount.translation().z() = 0.06;
    return model;
}

struct Arm::Solvers {
    explicit Solvers(const ArmModel& model) : arm{chain(model)}, position{arm}, jacobian{arm} {}

    KDL::Chain arm;
    KDL::ChainFkSolverPos_recursive position;
    KDL::ChainJntToJacSolver jacobian;
    KDL::JntArray angles{static_cast<unsigned>(joints)};
    KDL::Jacobian columns{static_cast<unsigned>(joints)};
    KDL::Frame pose{};
};

Arm::Arm(const ArmModel& model) : model_{model}, solvers_{std::make_unique<Solvers>(model)} {}
Arm::~Arm() = default;

Eigen::Isometry3d Arm::camera(const Joints& position) {
    solvers_->angles.data = position;
    solvers_->position.JntToCart(solvers_->angles, solvers_->pose);
    const KDL::Frame& pose = solvers_->pose;
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            result.linear()(row, column) = pose.M(row, column);
        }
        result.translation()[row] = pose.p(row);
    }
    return result;
}

Jacobian Arm::jacobian(const Joints& position) {
    const Eigen::Isometry3d pose = camera(position);
    solvers_->jacobian.JntToJac(solvers_->angles, solvers_->columns);
    // KDL refers the twist to the camera's origin, in the base's directions.
    const Jacobian in_base = solvers_->columns.data;
    Jacobian result;
    result.topRows<3>() = pose.linear().transpose() * in_base.topRows<3>();
    result.bottomRows<3>() = pose.linear().transpose() * in_base.bottomRows<3>();
    return result;
}

}  // namespace groundstate::kinematics
