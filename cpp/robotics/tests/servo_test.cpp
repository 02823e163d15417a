// The servo law: what the interaction matrix says, that the law converges, its limits, and what it refuses.
#include <gtest/gtest.h>

#include <limits>

#include "groundstate/plant/random.hpp"
#include "seen_square.hpp"

namespace groundstate::servo {
namespace {

TEST(ImagePoints, PixelsAndBack) {
    const Intrinsics camera{.fx = 600, .fy = 590, .cx = 320, .cy = 240};
    const ImagePoint point = camera.normalised({20, 300});
    EXPECT_DOUBLE_EQ(point.x, -0.5);
    EXPECT_DOUBLE_EQ(camera.pixel(point).u, 20);
    EXPECT_DOUBLE_EQ(camera.pixel(point).v, 300);
}

// The matrix is the derivative of the projection: compared with small movements of the camera.
TEST(InteractionMatrix, IsTheDerivativeOfWhatIsSeen) {
    const Eigen::Isometry3d camera = pose({0.05, -0.04, -0.6}, {0.2, -0.1, 0.3});
    const View view = seen_square(camera);
    const InteractionMatrix matrix = interaction_matrix(view.seen, view.depths);
    for (Eigen::Index axis = 0; axis < 6; ++axis) {
        Twist twist = Twist::Zero();
        twist[axis] = 1;
        const double h = 1e-6;
        const View ahead = seen_square(moved(camera, twist, h));
        const View behind = seen_square(moved(camera, twist, -h));
        for (std::size_t i = 0; i < points; ++i) {
            const auto row = static_cast<Eigen::Index>(2 * i);
            EXPECT_NEAR(matrix(row, axis), (ahead.seen[i].x - behind.seen[i].x) / (2 * h), 1e-7);
            EXPECT_NEAR(matrix(row + 1, axis), (ahead.seen[i].y - behind.seen[i].y) / (2 * h), 1e-7);
        }
    }
}

ServoSettings settings(Interaction interaction) { return {.gain = {1.0, 1.0, 0}, .interaction = interaction}; }

// From random poses to the desired one, by each choice of the matrix, with exact depths and with those by area.
TEST(Control, ConvergesFromManyPoses) {
    const Eigen::Isometry3d goal = pose({0, 0, -0.5}, {0, 0, 0});
    const View desired = seen_square(goal);
    for (const Interaction interaction : {Interaction::current, Interaction::desired, Interaction::mean}) {
        for (const bool by_area : {false, true}) {
            plant::Random random{7};
            for (int trial = 0; trial < 50; ++trial) {
                Eigen::Isometry3d camera = somewhere(random);
                double error = 0;
                for (int step = 0; step < 1500; ++step) {
                    View present = seen_square(camera);
                    if (by_area) {
                        present.depths = depths_by_area(present.seen, desired);
                    }
                    const Command command = control(settings(interaction), present, desired);
                    ASSERT_TRUE(command);
                    error = command.error;
                    camera = moved(camera, command.twist, 0.01);
                }
                EXPECT_LT(error, 1e-4) << "trial " << trial;
                EXPECT_LT((camera.translation() - goal.translation()).norm(), 1e-3);
                EXPECT_LT(Eigen::AngleAxisd{camera.linear()}.angle(), 1e-2);
            }
        }
    }
}

TEST(Control, LimitsKeepTheDirection) {
    const View desired = seen_square(pose({0, 0, -0.5}, {0, 0, 0}));
    const View present = seen_square(pose({0.2, 0.1, -0.8}, {0.2, -0.2, 0.5}));
    ServoSettings free = settings(Interaction::current);
    free.most_velocity = free.most_turning = 1e9;
    ServoSettings bound = free;
    bound.most_velocity = 0.05;
    bound.most_turning = 0.1;
    const Command wanted = control(free, present, desired);
    const Command command = control(bound, present, desired);
    EXPECT_EQ(wanted.shortened, 1);
    EXPECT_LT(command.shortened, 1);
    EXPECT_LE(command.twist.head<3>().norm(), 0.05 + 1e-12);
    EXPECT_LE(command.twist.tail<3>().norm(), 0.1 + 1e-12);
    EXPECT_NEAR(command.twist.normalized().dot(wanted.twist.normalized()), 1, 1e-12);
}

TEST(Control, TheGainFallsWithTheWay) {
    const Gain gain{.at_zero = 4, .at_infinity = 0.4, .slope_at_zero = 30};
    EXPECT_DOUBLE_EQ(gain(0), 4);
    EXPECT_NEAR(gain(1e3), 0.4, 1e-12);
    EXPECT_NEAR((gain(1e-7) - gain(0)) / 1e-7, -30, 1e-3);
}

Command controlled(const View& present, const View& desired) {
    return control(settings(Interaction::mean), present, desired);
}

TEST(Control, RefusesWhatGivesNoLaw) {
    const View good = seen_square(pose({0, 0, -0.5}, {0, 0, 0}));
    const auto expect = [&](View present, Defect defect) {
        const Command command = controlled(present, good);
        EXPECT_EQ(command.refusal, Refusal::seen);
        EXPECT_EQ(command.defect, defect);
        EXPECT_EQ(command.twist.norm(), 0);
        EXPECT_EQ(controlled(good, present).refusal, Refusal::desired);
    };
    View line = good;
    line.seen = {{{0, 0}, {0.1, 0.05}, {0.2, 0.1}, {0.3, 0.15}}};
    expect(line, Defect::collinear);
    View twice = good;
    twice.seen[1] = twice.seen[0];
    expect(twice, Defect::coincident);
    View behind = good;
    behind.depths[2] = -0.1;
    expect(behind, Defect::behind_camera);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        View none = good;
        none.seen[3].y = bad;
        expect(none, Defect::not_finite);
        none = good;
        none.depths[0] = bad;
        expect(none, Defect::not_finite);
    }
    View huge = good;
    huge.seen[0].x = 1e200;
    EXPECT_FALSE(controlled(huge, good));
}

// Whatever four points there are: a finite twist within the limits, or none.
TEST(Control, IsBoundedForAnyPoints) {
    plant::Random random{3};
    const View good = seen_square(pose({0, 0, -0.5}, {0, 0, 0}));
    int refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        View any;
        const double scale = std::pow(10.0, 12 * random.uniform() - 6);
        for (std::size_t i = 0; i < points; ++i) {
            any.seen[i] = {scale * random.normal(), random.happens(0.05) ? 0 : scale * random.normal()};
            any.depths[i] = std::exp(5 * random.normal());
        }
        const Command command = controlled(any, good);
        refused += !command;
        ASSERT_TRUE(command.twist.allFinite());
        ASSERT_LE(command.twist.head<3>().norm(), 0.25 + 1e-9);
        ASSERT_LE(command.twist.tail<3>().norm(), 0.8 + 1e-9);
    }
    EXPECT_LT(refused, 15000);
    EXPECT_GT(refused, 100);
}

TEST(DepthsByArea, AreExactAlongTheNormal) {
    const View desired = seen_square(pose({0, 0, -0.5}, {0, 0, 0}));
    const View present = seen_square(pose({0.1, -0.2, -0.9}, {0, 0, 0.4}));
    for (const double depth : depths_by_area(present.seen, desired)) {
        EXPECT_NEAR(depth, 0.9, 1e-12);
    }
}

}  // namespace
}  // namespace groundstate::servo
