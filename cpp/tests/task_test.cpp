// Tasks in virtual time: the grid, deadlines, overruns, waking by data, faults; and both kinds once in real time.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "groundstate/runtime.hpp"

namespace groundstate {
namespace {

constexpr std::int64_t ms = 1'000'000;

using Instants = std::vector<std::int64_t>;

// Runs one periodic task for so long; the durations of its cycles are given, the last one for ever.
std::vector<std::int64_t> begins(const Period& period, std::vector<std::int64_t> durations, std::int64_t until_ns,
                                 const Statistics** statistics, std::unique_ptr<PeriodicTask<VirtualClock>>& task,
                                 VirtualClock& clock) {
    std::vector<std::int64_t> begun;
    task = std::make_unique<PeriodicTask<VirtualClock>>(clock, "task", period, [&](const Cycle& cycle) {
        begun.push_back(clock.now_ns());
        const std::size_t last = durations.size() - 1;
        clock.sleep_until_ns(clock.now_ns() + durations[std::min(static_cast<std::size_t>(cycle.number), last)]);
    });
    task->start(0);
    clock.enter(1);
    clock.sleep_until_ns(until_ns);
    task->ask_to_stop();
    clock.leave();
    task->stop();
    *statistics = &task->statistics();
    return begun;
}

struct PeriodicTaskTest : testing::Test {
    VirtualClock clock{2};
    std::unique_ptr<PeriodicTask<VirtualClock>> task{};
    const Statistics* statistics = nullptr;

    std::vector<std::int64_t> run(const Period& period, std::vector<std::int64_t> durations, std::int64_t until_ns) {
        return begins(period, std::move(durations), until_ns, &statistics, task, clock);
    }
};

TEST(Tasks, AskForNothingUnlessTheyAreTold) {
    const Schedule schedule;
    EXPECT_EQ(schedule.rank, 0);
    EXPECT_EQ(schedule.grain_ns, 1);
    EXPECT_TRUE(schedule.counts_lateness);
    EXPECT_EQ(schedule.realtime.priority, 0);
    EXPECT_LT(schedule.realtime.processor, 0);
    Watchdog watchdog{0};
    const Cycle cycle{.watchdog = watchdog};
    EXPECT_EQ(cycle.number, 0);
    EXPECT_EQ(cycle.start_ns, 0);
    EXPECT_EQ(cycle.deadline_ns, never_ns);
    EXPECT_TRUE(cycle.rested);
}

TEST_F(PeriodicTaskTest, KeepsItsGridAndOffset) {
    EXPECT_EQ(run({.period_ns = 10, .offset_ns = 3}, {4}, 45), (Instants{3, 13, 23, 33, 43}));
    EXPECT_EQ(statistics->deadlines_met.value(), 5);
    EXPECT_EQ(statistics->worst_duration_ns.value(), 4);
}

TEST_F(PeriodicTaskTest, WorkOfAWholePeriodKeepsThePeriod) {
    EXPECT_EQ(run({.period_ns = 10}, {10}, 35), (Instants{0, 10, 20, 30}));
    EXPECT_EQ(statistics->deadlines_missed.value(), 0);
    EXPECT_EQ(statistics->overruns.value(), 0);
}

TEST_F(PeriodicTaskTest, ALateCycleDoesNotMoveTheGrid) {
    EXPECT_EQ(run({.period_ns = 10}, {2, 25, 2}, 55), (Instants{0, 10, 35, 37, 40, 50}));
    EXPECT_EQ(statistics->overruns.value(), 2);
    EXPECT_EQ(statistics->deadlines_missed.value(), 2);
    EXPECT_EQ(statistics->worst_lateness_ns.value(), 15);
}

// The first cycle takes so long that the second one begins late; both wait for what never comes.
TEST(PeriodicTasks, LateCyclesHaveSoMuchLessTimeToWait) {
    const auto ends = [](const Schedule& schedule) {
        VirtualClock clock{2};
        Semaphore<VirtualClock> busy{clock};
        Watchdog holder{0};
        EXPECT_TRUE(busy.acquire(0, holder));
        std::vector<std::int64_t> done;
        PeriodicTask<VirtualClock> task{clock, "task", {.period_ns = 100, .elaboration_ns = 40}, [&](const Cycle& cycle) {
            EXPECT_FALSE(busy.acquire(1, cycle.watchdog));
            clock.sleep_until_ns(clock.now_ns() + (cycle.number == 0 ? 90 : 40));
            done.push_back(clock.now_ns());
        }, schedule};
        task.start(0);
        clock.enter(1);
        clock.sleep_until_ns(250);
        task.ask_to_stop();
        clock.leave();
        task.stop();
        return done;
    };
    // 60 + 90; late by 50 of the 60 it might wait; in time again.
    EXPECT_EQ(ends({}), (Instants{150, 200, 300}));
    EXPECT_EQ(ends({.counts_lateness = false}), (Instants{150, 250, 350})) << "as the models count";
}

TEST_F(PeriodicTaskTest, IsWokenToStop) {
    EXPECT_EQ(run({.period_ns = 3'000'000'000}, {10}, 50), (Instants{0}));
    EXPECT_EQ(clock.now_ns(), 50) << "nobody waited for the next period";
}

TEST(Tasks, TellWhoeverIsToKnowThatAStepThrew) {
    VirtualClock clock{3};
    std::string told;
    PeriodicTask<VirtualClock> other{clock, "other", {.period_ns = 10}, [](const Cycle&) {}, {.rank = 1}};
    PeriodicTask<VirtualClock> failing{clock, "failing", {.period_ns = 10}, [](const Cycle& cycle) {
        if (cycle.number == 2) {
            throw std::runtime_error{"no solution"};
        }
    }, {.failed = [&](const std::string& task, const std::exception_ptr& failure) {
        told = task + ": " + reason_of(failure);
        other.ask_to_stop();
    }}};
    failing.start(0);
    other.start(0);
    clock.enter(2);
    clock.sleep_until_ns(100);
    EXPECT_EQ(told, "failing: no solution");
    EXPECT_EQ(failing.thread().state(), TaskState::faulted);
    EXPECT_EQ(other.thread().state(), TaskState::stopped);
    EXPECT_EQ(other.statistics().cycles.value(), 2);
    clock.leave();
}

TEST(Tasks, KnowWhetherTheyRestedWhenACycleWasDue) {
    VirtualClock clock{2};
    std::vector<bool> rested;
    PeriodicTask<VirtualClock> task{clock, "task", {.period_ns = 10}, [&](const Cycle& cycle) {
        rested.push_back(cycle.rested);
        clock.sleep_until_ns(clock.now_ns() + (cycle.number == 1 ? 15 : 2));
    }};
    task.start(0);
    clock.enter(1);
    clock.sleep_until_ns(45);
    task.ask_to_stop();
    clock.leave();
    task.stop();
    // Due at 0 when it starts, at 10, at 20 while the cycle before is at work, and then at 30.
    EXPECT_EQ(rested, (std::vector<bool>{false, true, false, true, true}));
}

TEST_F(PeriodicTaskTest, SkipsPeriodsThatHaveBegun) {
    EXPECT_EQ(run({.period_ns = 10, .late = Late::skip}, {2, 35, 2}, 65), (Instants{0, 10, 50, 60}));
    EXPECT_EQ(statistics->periods_skipped.value(), 3);
}

// Done at the very instant when a cycle is due, or just after it.
TEST(PeriodicTasks, APeriodHasBegunOnceTheCycleIsNotDoneWhenItIsDue) {
    const auto skipped = [](std::int64_t duration_ns) {
        VirtualClock clock{2};
        std::unique_ptr<PeriodicTask<VirtualClock>> task;
        const Statistics* statistics = nullptr;
        const Instants begun =
            begins({.period_ns = 10, .late = Late::skip}, {2, duration_ns, 2}, 55, &statistics, task, clock);
        return std::pair{statistics->periods_skipped.value(), begun[2]};
    };
    using Skipped = std::pair<std::int64_t, std::int64_t>;
    EXPECT_EQ(skipped(10), (Skipped{0, 20}));
    EXPECT_EQ(skipped(11), (Skipped{1, 30}));
    EXPECT_EQ(skipped(20), (Skipped{1, 30}));
    EXPECT_EQ(skipped(21), (Skipped{2, 40}));
}

TEST_F(PeriodicTaskTest, ADeadlineMayComeBeforeTheEndOfThePeriod) {
    run({.period_ns = 10, .deadline_ns = 3}, {3, 4}, 35);
    EXPECT_EQ(statistics->deadlines_met.value(), 1);
    EXPECT_EQ(statistics->deadlines_missed.value(), 3);
    EXPECT_EQ(statistics->overruns.value(), 0);
}

TEST_F(PeriodicTaskTest, ADeadlineMayComeAtOnce) {
    run({.period_ns = 10, .deadline_ns = 1}, {1, 2}, 35);
    EXPECT_EQ(statistics->deadlines_met.value(), 1);
    EXPECT_EQ(statistics->deadlines_missed.value(), 3);
}

TEST(PeriodicTasks, KnowWhenACycleWasDueAndMustBeDone) {
    VirtualClock clock{2};
    PeriodicTask<VirtualClock> task{clock, "task", {.period_ns = 10, .offset_ns = 3, .deadline_ns = 6}, [&](const Cycle& cycle) {
        EXPECT_EQ(cycle.start_ns, 10 * cycle.number + 3);
        EXPECT_EQ(cycle.deadline_ns, 10 * cycle.number + 9);
        clock.sleep_until_ns(clock.now_ns() + (cycle.number == 1 ? 15 : 2));
    }};
    task.start(0);
    clock.enter(1);
    clock.sleep_until_ns(45);
    task.ask_to_stop();
    clock.leave();
    task.stop();
    EXPECT_EQ(task.statistics().cycles.value(), 5);
}

// Where virtual time follows a model, what a cycle does within a tick takes no time.
TEST(PeriodicTasks, CountTimeByWholeGrains) {
    VirtualClock clock{2};
    PeriodicTask<VirtualClock> task{clock, "task", {.period_ns = 100}, [&](const Cycle& cycle) {
        clock.sleep_until_ns(clock.now_ns() + (cycle.number == 0 ? 27 : 139));
    }, {.grain_ns = 10}};
    task.start(0);
    clock.enter(1);
    clock.sleep_until_ns(205);
    task.ask_to_stop();
    EXPECT_EQ(task.statistics().worst_duration_ns.value(), 20) << "until the clock shows 27";
    clock.sleep_until_ns(250);
    clock.leave();
    task.stop();
    EXPECT_EQ(task.statistics().worst_duration_ns.value(), 130) << "from 100 to 239";
    EXPECT_EQ(task.statistics().worst_lateness_ns.value(), 0);
}

TEST(PeriodicTask, TheWatchdogsBudgetIsWhatThePeriodLeaves) {
    MonotonicClock clock;
    const PeriodicTask task{clock, "t", {.period_ns = 10, .elaboration_ns = 7}, [](const Cycle&) {}};
    EXPECT_EQ(task.watchdog().budget_ns(), 3);
    EXPECT_EQ(task.thread().state(), TaskState::built);
}

TEST(PeriodicTask, HasNoTimeOfItsOwnUnlessItIsGiven) {
    MonotonicClock clock;
    EXPECT_DEATH(PeriodicTask(clock, "t", {}, [](const Cycle&) {}), "period_ns > 0");
    const PeriodicTask task{clock, "t", {.period_ns = 10}, [](const Cycle&) {}};
    EXPECT_EQ(task.watchdog().budget_ns(), 10) << "its work takes none";
}

TEST(PeriodicTask, WorkThatDoesNotFitLeavesNothingToWait) {
    VirtualClock clock{1};
    const PeriodicTask<VirtualClock> task{clock, "task", {.period_ns = 5 * ms, .elaboration_ns = 7 * ms}, [](const Cycle&) {}};
    EXPECT_EQ(task.watchdog().budget_ns(), 0);
    EXPECT_EQ(task.watchdog().left_ns(), 0);
}

TEST(PeriodicTask, AStepThatThrowsEndsItsTaskAlone) {
    VirtualClock clock{3};
    PeriodicTask bad{clock, "bad", {.period_ns = 10}, [](const Cycle& cycle) {
                         if (cycle.number == 3) {
                             throw std::runtime_error{"no camera"};
                         }
                     }};
    PeriodicTask good{clock, "good", {.period_ns = 10}, [](const Cycle&) {}};
    bad.start(0);
    good.start(0);
    clock.enter(1);
    clock.sleep_until_ns(95);
    EXPECT_EQ(bad.thread().state(), TaskState::faulted);
    EXPECT_EQ(good.thread().state(), TaskState::running);
    EXPECT_THROW(std::rethrow_exception(bad.thread().failure()), std::runtime_error);
    good.ask_to_stop();
    clock.leave();
    good.stop();
    EXPECT_EQ(bad.statistics().cycles.value(), 3);
    EXPECT_EQ(good.statistics().cycles.value(), 10);
}

// Camera (10 ms), asynchronous servoing (3 ms of work, master of both buffers), robot (5 ms): the paper's Figure 2.
TEST(AsynchronousTask, IsWokenByDataAndNeverPolls) {
    VirtualClock clock{4};
    LockedBuffer<int, 2, Master::reader, VirtualClock> images{clock};
    LockedBuffer<int, 2, Master::writer, VirtualClock> set_points{clock};
    std::vector<std::int64_t> servoed;
    std::vector<std::uint64_t> reached;
    PeriodicTask camera{clock, "camera", {.period_ns = 10 * ms, .elaboration_ns = 5 * ms}, [&](const Cycle& cycle) {
                            if (auto writing = images.write(cycle.watchdog)) {
                                *writing = static_cast<int>(cycle.number);
                                writing.publish();
                            }
                        }};
    AsynchronousTask servoing{clock, "servoing", 100 * ms, [&] { return images.available(); },
                              [&](const Cycle& cycle) {
                                  const auto image = images.read(cycle.watchdog);
                                  servoed.push_back(clock.now_ns() / ms);
                                  EXPECT_TRUE(image.fresh());
                                  clock.sleep_until_ns(clock.now_ns() + 3 * ms);
                                  auto set_point = set_points.write(cycle.watchdog);
                                  *set_point = *image;
                                  set_point.publish_at(image.stamp_ns());
                              }};
    images.wakes(servoing.trigger());
    PeriodicTask robot{clock, "robot", {.period_ns = 5 * ms, .elaboration_ns = 2 * ms}, [&](const Cycle& cycle) {
                           const auto set_point = set_points.read(cycle.watchdog);
                           if (set_point && set_point.fresh()) {
                               reached.push_back(set_point.sequence());
                               EXPECT_LE(clock.now_ns() - set_point.stamp_ns(), 5 * ms) << "age";
                           }
                       }};
    camera.start(0);
    servoing.start();
    robot.start(0);
    clock.enter(9);
    clock.sleep_until_ns(49 * ms);
    servoing.ask_to_stop();
    camera.ask_to_stop();
    robot.ask_to_stop();
    clock.leave();
    camera.stop();
    servoing.stop();
    robot.stop();
    EXPECT_EQ(servoed, (std::vector<std::int64_t>{0, 10, 20, 30, 40}));
    EXPECT_EQ(servoing.statistics().cycles.value(), 5) << "not once in vain";
    EXPECT_EQ(servoing.statistics().worst_duration_ns.value(), 3 * ms);
    EXPECT_EQ(reached, (std::vector<std::uint64_t>{1, 2, 3, 4, 5}));
    EXPECT_EQ(camera.statistics().deadlines_missed.value(), 0);
}

TEST(AsynchronousTask, ItsCyclesAreNumberedAndDueWhenTheyBegin) {
    VirtualClock clock{2};
    std::vector<std::int64_t> begun;
    AsynchronousTask task{clock, "eager", 7, [] { return true; }, [&](const Cycle& cycle) {
        EXPECT_EQ(cycle.number, static_cast<std::int64_t>(begun.size()));
        EXPECT_EQ(cycle.start_ns, clock.now_ns());
        EXPECT_EQ(cycle.deadline_ns, never_ns);
        EXPECT_EQ(cycle.watchdog.left_ns(), 7) << "anew in each cycle";
        EXPECT_TRUE(cycle.rested);
        begun.push_back(cycle.start_ns);
        cycle.watchdog.waited(2);
        clock.sleep_until_ns(clock.now_ns() + 10);
    }};
    task.start();
    clock.enter(1);
    clock.sleep_until_ns(25);
    task.ask_to_stop();
    clock.leave();
    task.stop();
    EXPECT_EQ(begun, (Instants{0, 10, 20})) << "from the first instant on, if it is given no origin";
}

TEST(AsynchronousTask, StopsWhileItRests) {
    MonotonicClock clock;
    AsynchronousTask task{clock, "idle", ms, [] { return false; }, [](const Cycle&) {}};
    task.start();
    task.stop();
    EXPECT_EQ(task.thread().state(), TaskState::stopped);
    EXPECT_EQ(task.statistics().cycles.value(), 0);
}

TEST(AsynchronousTask, BeginsAtTheOrigin) {
    MonotonicClock clock;
    Signal done{clock};
    std::atomic<std::int64_t> first_ns{0};
    AsynchronousTask task{clock, "eager", ms, [&] { return first_ns == 0; }, [&](const Cycle& cycle) {
        first_ns = cycle.start_ns;
        done.raise();
    }};
    const std::int64_t origin_ns = clock.now_ns() + 5 * ms;
    task.start(origin_ns);
    for (std::uint32_t seen = done.count(); first_ns == 0; seen = done.count()) {
        done.wait_while(seen, clock.now_ns() + 100 * ms);
    }
    task.stop();
    EXPECT_GE(first_ns, origin_ns);
}

// The thread's name is known only if it has at most 15 letters.
TEST(RealTime, AThreadHasTheBeginningOfItsTasksName) {
    MonotonicClock clock;
    std::array<char, 32> name{};
    AsynchronousTask task{clock, "a name of twenty-nine letters", ms, [&] { return name[0] == 0; }, [&](const Cycle&) {
        pthread_getname_np(pthread_self(), name.data(), name.size());
    }};
    EXPECT_EQ(task.thread().name(), "a name of twenty-nine letters");
    task.start();
    while (task.statistics().cycles.value() == 0) {
        std::this_thread::yield();
    }
    task.stop();
    EXPECT_STREQ(name.data(), "a name of twent");
}

// Nothing but the state says that the failure may be asked.
TEST(RealTime, WhoSeesThatATaskFailedSeesWhy) {
    MonotonicClock clock;
    PeriodicTask task{clock, "failing", {.period_ns = ms}, [](const Cycle&) { throw std::runtime_error{"no arm"}; },
                      {.failed = [](const std::string&, const std::exception_ptr&) {}}};
    task.start(clock.now_ns());
    while (task.thread().state() != TaskState::faulted) {
        std::this_thread::yield();
    }
    EXPECT_EQ(reason_of(task.thread().failure()), "no arm");
}

TEST(RealTime, BothKindsOfTaskRun) {
    MonotonicClock clock;
    WaitFreeBuffer<std::int64_t, 3, MonotonicClock> buffer{clock};
    Signal done{clock};
    // What is not granted is refused, and the task runs all the same.
    PeriodicTask producer{clock, "producer", {.period_ns = ms},
                          [&](const Cycle& cycle) {
                              auto writing = buffer.write(cycle.watchdog);
                              *writing = cycle.number;
                              writing.publish();
                          },
                          {.realtime = {.priority = 20, .processor = 0}}};
    std::atomic<std::int64_t> last{-1};
    AsynchronousTask consumer{clock, "consumer", ms, [&] { return buffer.available(); },
                              [&](const Cycle& cycle) {
                                  const auto reading = buffer.read(cycle.watchdog);
                                  EXPECT_GT(*reading, last.load());
                                  last = *reading;
                                  done.raise();
                              }};
    buffer.wakes(consumer.trigger());
    consumer.start();
    producer.start(clock.now_ns());
    for (std::uint32_t seen = done.count(); last < 20; seen = done.count()) {
        done.wait_while(seen, clock.now_ns() + 100 * ms);
    }
    producer.stop();
    consumer.stop();
    EXPECT_GE(buffer.account().read, 1);
    EXPECT_EQ(producer.thread().state(), TaskState::stopped);
    EXPECT_NE(producer.thread().granted().priority, Grant::not_asked);
    EXPECT_NE(producer.thread().granted().processor, Grant::not_asked);
    EXPECT_EQ(consumer.thread().granted().priority, Grant::not_asked);
}

}  // namespace
}  // namespace groundstate
