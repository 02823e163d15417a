// The arm: its Jacobian against small movements, joint velocities against KDL's own solver, limits.
#include <gtest/gtest.h>

#include <kdl/chainiksolvervel_wdls.hpp>

#include "groundstate/kinematics/joint_velocities.hpp"
#include "groundstate/plant/joint.hpp"
#include "groundstate/plant/random.hpp"

namespace groundstate::kinematics {
namespace {

using Twist = Eigen::Matrix<double, 6, 1>;

Joints somewhere(const ArmModel& model, plant::Random& random) {
    Joints q;
    for (std::size_t i = 0; i < joints; ++i) {
        const JointLimit& limit = model.limits[i];
        q[static_cast<Eigen::Index>(i)] = limit.least + (limit.most - limit.least) * (0.2 + 0.6 * random.uniform());
    }
    return q;
}

TEST(Arm, TheJacobianIsTheDerivativeOfThePose) {
    Arm arm{example_arm()};
    plant::Random random{1};
    for (int trial = 0; trial < 20; ++trial) {
        const Joints q = somewhere(arm.model(), random);
        const Jacobian jacobian = arm.jacobian(q);
        const Eigen::Isometry3d here = arm.camera(q);
        for (Eigen::Index j = 0; j < 6; ++j) {
            const double h = 1e-6;
            const Joints one = Joints::Unit(j);
            const Eigen::Isometry3d step = arm.camera(q - h * one).inverse() * arm.camera(q + h * one);
            const Eigen::Vector3d velocity =
                here.linear().transpose() *
                (arm.camera(q + h * one).translation() - arm.camera(q - h * one).translation()) / (2 * h);
            const Eigen::AngleAxisd turn{step.linear()};
            EXPECT_LT((jacobian.col(j).head<3>() - velocity).norm(), 1e-7);
            EXPECT_LT((jacobian.col(j).tail<3>() - turn.axis() * turn.angle() / (2 * h)).norm(), 1e-6);
        }
    }
}

// The links by hand: rotations about z and x and shifts, multiplied.
TEST(Arm, TheCameraIsWhereTheLinksPutIt) {
    Arm arm{example_arm()};
    plant::Random random{2};
    const Joints q = somewhere(arm.model(), random);
    Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
    for (std::size_t i = 0; i < joints; ++i) {
        const Link& link = arm.model().links[i];
        expected = expected * Eigen::AngleAxisd{q[static_cast<Eigen::Index>(i)] + link.theta, Eigen::Vector3d::UnitZ()} *
                   Eigen::Translation3d{link.a, 0, link.d} * Eigen::AngleAxisd{link.alpha, Eigen::Vector3d::UnitX()};
    }
    expected = expected * arm.model().camera_mount;
    EXPECT_LT((arm.camera(q).matrix() - expected.matrix()).norm(), 1e-12);
}

TEST(JointVelocities, MoveTheCameraByTheTwist) {
    Arm arm{example_arm()};
    plant::Random random{3};
    int exact = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Joints q = somewhere(arm.model(), random);
        const Jacobian jacobian = arm.jacobian(q);
        Twist twist;
        twist << 0.02, -0.03, 0.01, 0.05, 0.02, -0.04;
        const JointVelocities result = joint_velocities(arm.model().limits, {}, jacobian, q, twist);
        if (result.least_singular > 0.05 && result.held == 0) {
            EXPECT_LT((jacobian * result.velocity - result.shortened * twist).norm(), 1e-6);
            ++exact;
        }
    }
    EXPECT_GT(exact, 100);
}

// KDL's weighted damped least squares, with the same damping everywhere.
TEST(JointVelocities, AgreeWithKdlNearSingularPositions) {
    const ArmModel model = example_arm();
    Arm arm{model};
    KDL::Chain chain;
    for (const Link& link : model.links) {
        chain.addSegment(KDL::Segment{KDL::Joint{KDL::Joint::RotZ}, KDL::Frame::DH(link.a, link.alpha, link.d, link.theta)});
    }
    plant::Random random{4};
    for (const double bend : {0.0, 0.01, 0.1, 0.5}) {
        Joints q = somewhere(model, random);
        q[4] = bend;  // the wrist stretched: singular
        // KDL's twist is that of the flange, in the base's directions; the camera's is carried over.
        const Jacobian jacobian = arm.jacobian(q);
        const double damping = 0.05;
        KDL::ChainIkSolverVel_wdls solver{chain, 1e-12};
        Arm flange{[&] {
            ArmModel bare = model;
            bare.camera_mount.setIdentity();
            return bare;
        }()};
        const Jacobian at_flange = flange.jacobian(q);
        const Eigen::Matrix3d directions = flange.camera(q).linear();
        Twist twist;
        twist << 0.02, -0.03, 0.01, 0.05, 0.02, -0.04;
        KDL::JntArray angles{6}, velocities{6};
        angles.data = q;
        const Eigen::Vector3d linear = directions * twist.head<3>();
        const Eigen::Vector3d angular = directions * twist.tail<3>();
        solver.setEps(1e9);  // always damped, in full
        solver.setLambda(damping);
        solver.CartToJnt(angles, {{linear.x(), linear.y(), linear.z()}, {angular.x(), angular.y(), angular.z()}}, velocities);
        auto limits = model.limits;
        for (JointLimit& limit : limits) {
            limit = {-1e9, 1e9, 1e9};
        }
        // Damped in full: the threshold so high that nearness is 1.
        const JointVelocities own = joint_velocities(limits, {.damp_below = 1e12, .damping = damping}, at_flange, q, twist);
        EXPECT_TRUE(jacobian.allFinite());
        EXPECT_LT((own.velocity - velocities.data).norm(), 1e-6) << bend;
    }
}

TEST(JointVelocities, KeepTheLimits) {
    Arm arm{example_arm()};
    plant::Random random{5};
    for (int trial = 0; trial < 300; ++trial) {
        Joints q = somewhere(arm.model(), random);
        Twist twist;
        for (Eigen::Index i = 0; i < 6; ++i) {
            twist[i] = 3 * random.normal();
        }
        // Follow one wish for long: no joint leaves its range.
        for (int step = 0; step < 400; ++step) {
            const JointVelocities result = joint_velocities(arm.model().limits, {}, arm.jacobian(q), q, twist);
            ASSERT_TRUE(result.velocity.allFinite());
            for (std::size_t i = 0; i < joints; ++i) {
                const auto j = static_cast<Eigen::Index>(i);
                ASSERT_LE(std::abs(result.velocity[j]), arm.model().limits[i].most_velocity + 1e-9);
            }
            q += 0.02 * result.velocity;
            for (std::size_t i = 0; i < joints; ++i) {
                const auto j = static_cast<Eigen::Index>(i);
                ASSERT_LE(q[j], arm.model().limits[i].most + 1e-9);
                ASSERT_GE(q[j], arm.model().limits[i].least - 1e-9);
            }
        }
    }
}

TEST(Joint, FollowsItsCommandAndMeasuresItself) {
    plant::Joint joint{{.lag_s = 0.004, .most_acceleration = 12, .encoder_step = 1e-4}, 0.5};
    plant::Random random{6};
    joint.command(0.6);
    joint.pass(0.0005);
    EXPECT_DOUBLE_EQ(joint.acceleration(), 12);
    for (int i = 0; i < 400; ++i) {
        joint.pass(0.0005);
    }
    EXPECT_NEAR(joint.velocity(), 0.6, 1e-6);
    EXPECT_NEAR(joint.measured(random), joint.position(), 0.5e-4 + 1e-12);
    EXPECT_NEAR(std::remainder(joint.measured(random), 1e-4), 0, 1e-12);
}

}  // namespace
}  // namespace groundstate::kinematics
