// The whole controller with the cell in virtual time: it converges, it does so the same each time, and whatever goes wrong
// it still converges or comes to rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "closed_loop.hpp"

namespace controller_system {
namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t second = 1'000'000'000;
// Three seconds for each of the two goals, which is enough to come to rest.
const groundstate::closed_loop::RunSettings short_run{.span_ns = 6 * second};

void expect_converged(const Loop& loop, double feature_error, double mm, double degrees) {
    EXPECT_LT(loop.feature_error, feature_error);
    EXPECT_LT(loop.position_error * 1e3, mm);
    EXPECT_LT(loop.turn_error * 180 / M_PI, degrees);
    EXPECT_FALSE(loop.holding);
    EXPECT_EQ(loop.servoing->sights().back().target, 2);
}

TEST(ClosedLoop, ConvergesToBothGoals) {
    const Loop loop = run({});
    expect_converged(loop, 1e-3, 1, 0.1);
    // The first goal was reached before the second one was sent.
    double before = 1;
    for (const Sight& sight : loop.servoing->sights()) {
        EXPECT_EQ(sight.tracked.track, groundstate::vision::Track::tracking);
        before = sight.target == 1 ? sight.command.error : before;
    }
    EXPECT_LT(before, 1e-3);
    EXPECT_GT(loop.servoing->sights().size(), 700u);
    EXPECT_EQ(loop.servoing->searches(), 1);
}

// Set-points are handed over where the machine says so, and nowhere else: the robot follows no image of which it does not.
TEST(ClosedLoop, OnlyWhatTheMachineGuidesIsFollowed) {
    const Loop loop = run({.run = short_run, .disturbances = {.dropped = true, .occlusion = true}});
    const auto& sights = loop.servoing->sights();
    const auto guided = [&](const Sight& sight) {
        return (sight.mode == ServoMode::TRACKING || sight.mode == ServoMode::CONVERGED || sight.mode == ServoMode::COVERED) &&
               sight.command;
    };
    const auto of = [&](std::int64_t captured_ns) {
        return std::find_if(sights.begin(), sights.end(), [&](const Sight& s) { return s.captured_ns == captured_ns; });
    };
    long followed = 0;
    for (const Motion& motion : loop.robot->motions()) {
        if (motion.captured_ns >= 0) {
            const auto sight = of(motion.captured_ns);
            ASSERT_NE(sight, sights.end());
            EXPECT_TRUE(guided(*sight));
            ++followed;
        }
    }
    EXPECT_GT(followed, 900);
    EXPECT_EQ(sights.back().mode, ServoMode::CONVERGED);
    const auto covered = [](const Sight& sight) { return sight.mode == ServoMode::COVERED; };
    EXPECT_GT(std::count_if(sights.begin(), sights.end(), covered), 10);
}

// Everything that was recorded, as bytes; padding is not looked at.
std::vector<double> numbers(const Loop& loop) {
    std::vector<double> result;
    for (const Sight& sight : loop.servoing->sights()) {
        result.push_back(static_cast<double>(sight.at_ns));
        for (const auto& pixel : sight.tracked.pixels) {
            result.insert(result.end(), {pixel.u, pixel.v});
        }
        result.insert(result.end(), sight.command.twist.begin(), sight.command.twist.end());
    }
    for (const Motion& motion : loop.robot->motions()) {
        result.insert(result.end(), motion.measured.begin(), motion.measured.end());
        result.insert(result.end(), motion.position.begin(), motion.position.end());
    }
    for (const Drive& drive : loop.motor->drives()) {
        result.push_back(drive.fastest);
    }
    return result;
}

TEST(ClosedLoop, IsTheSameForASeedAndAnotherForAnother) {
    const Disturbances all{.noise = true, .dropped = true, .slow = true, .occlusion = true};
    const auto of = [&](std::uint64_t seed) {
        return numbers(run({.run = {.span_ns = 3 * second, .seed = seed}, .disturbances = all}));
    };
    const std::vector<double> first = of(1);
    const std::vector<double> again = of(1);
    ASSERT_GT(first.size(), 10000u);
    ASSERT_EQ(first.size(), again.size());
    EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof(double)), 0);
    EXPECT_NE(first, of(2));
}

TEST(ClosedLoop, ConvergesInNoise) {
    expect_converged(run({.run = short_run, .disturbances = {.noise = true}}), 2e-3, 2, 0.3);
}

TEST(ClosedLoop, ConvergesThoughImagesAreLost) {
    const Loop loop = run({.run = short_run, .disturbances = {.dropped = true}});
    expect_converged(loop, 1e-3, 1, 0.1);
    EXPECT_GT(loop.frames.lost, 30);
}

TEST(ClosedLoop, ConvergesThoughImagesAreSlow) {
    const Loop loop = run({.run = short_run, .disturbances = {.slow = true}});
    expect_converged(loop, 1e-3, 1, 0.1);
    EXPECT_GT(loop.frames.timeouts + loop.frames.lost, 30);
}

TEST(ClosedLoop, ConvergesThoughDiscsAreCovered) {
    const Loop loop = run({.run = short_run, .disturbances = {.occlusion = true}});
    expect_converged(loop, 2e-3, 2, 0.3);
    long predicted = 0;
    for (const Sight& sight : loop.servoing->sights()) {
        predicted += sight.tracked.track == groundstate::vision::Track::predicting;
    }
    EXPECT_GT(predicted, 10);
}

TEST(ClosedLoop, ConvergesWithAllAtOnceForManySeeds) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(seed);
        expect_converged(run({.run = {.span_ns = short_run.span_ns, .seed = seed}, .disturbances = {.noise = true, .dropped = true, .slow = true, .occlusion = true}}),
                         5e-3, 5, 0.5);
    }
}

// The camera is gone in the middle of the way: the arm comes to rest, and stays there.
TEST(ClosedLoop, HoldsWhenTheCameraIsGone) {
    const Loop loop = run({.run = {.span_ns = 3 * second}, .disturbances = {.unplugged_s = 0.8}});
    EXPECT_TRUE(loop.holding);
    EXPECT_LT(loop.fastest, 5e-3) << "the noise of the encoders is left";
    EXPECT_GT(loop.position_error, 0.01);
    double fastest = 0;
    for (const Motion& motion : loop.robot->motions()) {
        const std::int64_t since = motion.at_ns - 800 * ms;
        EXPECT_EQ(motion.holding, motion.captured_ns < 0);
        if (since > 150 * ms) {
            EXPECT_TRUE(motion.holding);
        }
        if (since > 600 * ms) {
            for (const double velocity : motion.velocity) {
                fastest = std::max(fastest, std::abs(velocity));
            }
        }
    }
    EXPECT_LT(fastest, 1e-6);
}

// How far the joints go in a second, beginning half a second after the run.
double creeping(const Loop& loop, std::int64_t end_ns) {
    const Joints before = loop.cell->measured(end_ns + 500 * ms);
    return (loop.cell->measured(end_ns + 1500 * ms) - before).cwiseAbs().maxCoeff();
}

TEST(ClosedLoop, StandsWhenAHookThrows) {
    const Loop loop = run({.run = {.span_ns = 2 * second}, .hook_fault = HookFault::throws, .hook_fails_s = 0.3});
    const groundstate::Ending& ending = loop.account.ending;
    EXPECT_EQ(ending.kind, groundstate::Ending::Kind::faulted);
    EXPECT_EQ(ending.task, "visual_servoing");
    EXPECT_EQ(ending.reason, "the law has no solution");
    EXPECT_FALSE(loop.converged());
    EXPECT_LT(loop.motor->drives().size(), 400u) << "the others were stopped, too";
    EXPECT_GT(loop.motor->drives().back().fastest, 0.05) << "in the middle of a movement";
    EXPECT_LT(creeping(loop, 2 * second), 1e-3);
}

// What is not a number is counted, and never comes to the joints: they are brought to rest as without images.
TEST(ClosedLoop, HoldsWhenAHookGivesWhatIsNotANumber) {
    const Loop loop = run({.run = {.span_ns = 2 * second}, .hook_fault = HookFault::not_a_number, .hook_fails_s = 0.3});
    EXPECT_TRUE(loop.account.ending);
    EXPECT_GT(loop.account.tasks[2].invalid, 50);
    EXPECT_TRUE(loop.holding);
    EXPECT_LT(loop.fastest, 5e-3);
    for (const Motion& motion : loop.robot->motions()) {
        ASSERT_TRUE(finite(motion.position) && finite(motion.velocity));
    }
}

TEST(Images, OfAnotherSizeAreNotHandedOver) {
    groundstate::Watchdog watchdog{ms};
    ImageGrabber grabber{[](groundstate::FrameView, groundstate::Watchdog&) {
        return groundstate::Grab{.outcome = groundstate::Outcome::other_shape};
    }};
    const auto image = std::make_unique<CameraToVs>();
    Camera::Out out{*image};
    EXPECT_FALSE(grabber.grab({.watchdog = watchdog}, {}, out));
    EXPECT_EQ(grabber.without_image(), 1);
}

struct MotorTest : testing::Test {
    std::int64_t now_ns = second;
    Joints commanded = Joints::Zero();
    JointDrives drives{[this] { return now_ns; }, [this](std::int64_t, const Joints& v) { commanded = v; }, {}, 1000};
    groundstate::Watchdog watchdog{ms};
    RobotToMotor set{.position = {}, .velocity = {0.5, -0.4, 0.3, 0, 0, 0}, .set_ns = second};
    EncoderToMotor encoder{};

    void cycle() {
        encoder.measured_ns = now_ns;
        Motor::Out out;
        drives.drive({.watchdog = watchdog}, {{&encoder, true, 1, now_ns}, {&set, false, 1, set.set_ns}}, out);
        now_ns += ms;
    }
};

TEST_F(MotorTest, FollowsAFreshSetPoint) {
    cycle();
    EXPECT_NEAR(commanded[0], 0.5, 1e-12);
    EXPECT_FALSE(drives.drives().back().holding);
}

TEST_F(MotorTest, BrakesOnARampWhenTheSetPointIsTooOld) {
    for (int i = 0; i < 26; ++i) {
        cycle();
    }
    double before = commanded.cwiseAbs().maxCoeff();
    EXPECT_GT(before, 0.4);
    for (int i = 0; i < 200; ++i) {
        cycle();
        EXPECT_TRUE(drives.drives().back().holding);
        const double now = commanded.cwiseAbs().maxCoeff();
        EXPECT_LE(now, before);
        EXPECT_GE(now, before - 8 * 0.001 - 1e-12);
        before = now;
    }
    EXPECT_EQ(before, 0);
    // Led again, it goes on.
    set.set_ns = now_ns;
    set.position = encoder.position;
    cycle();
    EXPECT_NEAR(commanded[0], 0.5, 1e-12);
}

TEST_F(MotorTest, StandsAtASafeStop) {
    cycle();
    drives.safe_stop();
    EXPECT_EQ(commanded.cwiseAbs().maxCoeff(), 0);
}

TEST(Data, WhatIsNotANumberIsNotHandedOver) {
    VsToRobot twist;
    EXPECT_TRUE(valid(twist));
    twist.twist[3] = NAN;
    EXPECT_FALSE(valid(twist));
}

}  // namespace
}  // namespace controller_system
