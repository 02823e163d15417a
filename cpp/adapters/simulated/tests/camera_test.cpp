// Which frame a grab gives, by the clock alone; that a run is the same each time; and the arm that moves the camera.
#include <gtest/gtest.h>

#include <groundstate/runtime.hpp>

#include "rig.hpp"

namespace groundstate::simulated {
namespace {

constexpr std::int64_t ms = 1'000'000;

Pose still(std::int64_t) { return {}; }

class CameraTest : public testing::Test {
  protected:
    void open(const Settings& settings, PoseAt pose_at = still) {
        opened.emplace(Camera<VirtualClock>::open(clock, four_discs(), std::move(pose_at), settings));
        ASSERT_TRUE(*opened) << opened->failure().text;
    }

    Grab grab(std::int64_t budget_ns = 100 * ms) {
        Watchdog watchdog{budget_ns};
        return (*opened)->grab(frame.view(), watchdog);
    }

    VirtualClock clock;
    std::optional<Opened<Camera<VirtualClock>>> opened{};
    Frame<640, 480> frame{};
};

TEST_F(CameraTest, GivesEachFrameWhenItHasArrived) {
    open({.readout_ns = 2 * ms});
    for (std::uint64_t number = 1; number <= 5; ++number) {
        const Grab got = grab();
        EXPECT_EQ(got.sequence, number);
        EXPECT_EQ(got.stamp_ns, static_cast<std::int64_t>(number - 1) * 10 * ms) << "when it was taken";
        EXPECT_EQ(clock.now_ns(), got.stamp_ns + 2 * ms) << "when it had arrived";
    }
}

TEST_F(CameraTest, GivesTheNewestAndCountsTheOthers) {
    open({});
    clock.sleep_until_ns(35 * ms);
    const Grab got = grab();
    EXPECT_EQ(got.sequence, 4u);
    EXPECT_EQ(got.lost, 3u);
    EXPECT_EQ(clock.now_ns(), 35 * ms) << "without waiting";
}

TEST_F(CameraTest, WaitsNoLongerThanTheBudget) {
    open({});
    EXPECT_TRUE(grab());
    EXPECT_EQ(grab(3 * ms).outcome, Outcome::timeout);
    EXPECT_EQ(clock.now_ns(), 3 * ms);
    EXPECT_EQ(grab(0).outcome, Outcome::timeout);
    EXPECT_EQ(clock.now_ns(), 3 * ms);
    EXPECT_EQ(grab(7 * ms).sequence, 2u) << "it arrives as the budget ends";
}

TEST_F(CameraTest, NothingArrivesWhenAllIsLost) {
    open({.faults = {.lost = 1}});
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(grab(25 * ms).outcome, Outcome::timeout);
    }
    EXPECT_EQ(clock.now_ns(), 2'500 * ms);
    EXPECT_EQ((*opened)->account().delivered, 0);
}

TEST_F(CameraTest, SlowFramesComeLateOrNeverAndOrderIsKept) {
    open({.readout_ns = ms, .faults = {.slow = 0.3, .slow_ns = 25 * ms}});
    int late = 0;
    std::uint64_t last = 0;
    for (int i = 0; i < 300; ++i) {
        const Grab got = grab();
        ASSERT_TRUE(got);
        EXPECT_EQ(got.sequence, last + 1 + got.lost);
        last = got.sequence;
        late += clock.now_ns() > got.stamp_ns + ms;
    }
    EXPECT_GT((*opened)->account().lost, 0) << "overtaken by a newer one";
    EXPECT_GT(late, 0) << "three slow ones on end";
}

TEST_F(CameraTest, TheSameSeedGivesTheSameRun) {
    const auto run = [&](std::uint64_t seed) {
        VirtualClock own;
        const Settings settings{.faults = {.seed = seed, .lost = 0.2, .slow = 0.2, .slow_ns = 4 * ms, .noise = 2}};
        auto camera = Camera<VirtualClock>::open(own, four_discs(), still, settings);
        std::vector<std::uint64_t> digest;
        for (int i = 0; i < 30; ++i) {
            Watchdog watchdog{100 * ms};
            const Grab got = camera->grab(frame.view(), watchdog);
            std::uint64_t sum = got.sequence;
            for (const std::uint8_t pixel : frame.pixels) {
                sum = sum * 31 + pixel;
            }
            digest.push_back(sum);
        }
        return digest;
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
}

TEST_F(CameraTest, AsksWhereItWasWhenTheFrameWasTaken) {
    std::vector<std::int64_t> asked;
    open({.readout_ns = 4 * ms}, [&](std::int64_t taken_ns) {
        asked.push_back(taken_ns);
        return Pose{.position = {static_cast<double>(taken_ns) * 1e-9, 0, 0}};
    });
    (void)grab();
    (void)grab();
    EXPECT_EQ(asked, (std::vector<std::int64_t>{0, 10 * ms}));
    const auto centre = (*opened)->scene().project({-0.1, -0.1, 1}, {.position = {0.01, 0, 0}});
    EXPECT_GT(frame.view().row(static_cast<int>(centre->y))[static_cast<int>(centre->x)], 200);
}

TEST_F(CameraTest, RefusesWhatIsNoCamera) {
    for (const Settings& settings : {Settings{.shape = {0, 480}}, Settings{.period_ns = 0}, Settings{.readout_ns = -1},
                                     Settings{.faults = {.slow_ns = -1}}}) {
        const auto refused = Camera<VirtualClock>::open(clock, four_discs(), still, settings);
        EXPECT_FALSE(refused);
        EXPECT_EQ(refused.failure().error, OpenError::refused);
        EXPECT_NE(refused.failure().text.find("needs"), std::string::npos);
    }
    EXPECT_FALSE(Camera<VirtualClock>::open(clock, four_discs(), nullptr));
}

// The camera's task writes into a buffer in place, the one that looks at the images reads there: in virtual time.
template <class B>
void hand_over(std::uint64_t expected_frames) {
    VirtualClock clock{3};
    B images{clock};
    auto camera = Camera<VirtualClock>::open(clock, four_discs(), still, {.faults = {.noise = 2}});
    std::uint64_t looked_at = 0;
    AsynchronousTask looking{clock, "looking", ms, [&] { return images.available(); }, [&](const Cycle& cycle) {
                                 const auto image = images.read(cycle.watchdog);
                                 ASSERT_TRUE(image && image.fresh());
                                 EXPECT_GT(image->view().row(180)[260], 150);
                                 EXPECT_EQ(image.stamp_ns(), static_cast<std::int64_t>(image.sequence() - 1) * 10 * ms);
                                 ++looked_at;
                             }};
    images.wakes(looking.trigger());
    PeriodicTask taking{clock, "taking", {.period_ns = 10 * ms, .elaboration_ns = 4 * ms}, [&](const Cycle& cycle) {
                            auto image = images.write(cycle.watchdog);
                            ASSERT_TRUE(image);
                            const Grab got = camera->grab(image->view(), cycle.watchdog);
                            ASSERT_TRUE(got);
                            image.publish_at(got.stamp_ns);
                        }};
    looking.start();
    taking.start(0);
    clock.enter(2);
    clock.sleep_until_ns(static_cast<std::int64_t>(expected_frames) * 10 * ms - 5 * ms);
    taking.ask_to_stop();
    looking.ask_to_stop();
    clock.leave();
    taking.stop();
    looking.stop();
    EXPECT_EQ(looked_at, expected_frames);
    EXPECT_EQ(camera->account().delivered, static_cast<std::int64_t>(expected_frames));
    EXPECT_EQ(camera->account().lost, 0);
}

TEST(CameraTask, HandsOverEachImageInPlace) {
    hand_over<WaitFreeBuffer<Frame<640, 480>, 3, VirtualClock>>(20);
    hand_over<LockedBuffer<Frame<640, 480>, 2, Master::reader, VirtualClock>>(20);
    hand_over<LockedBuffer<Frame<640, 480>, 3, Master::writer, VirtualClock>>(20);
}

}  // namespace
}  // namespace groundstate::simulated
