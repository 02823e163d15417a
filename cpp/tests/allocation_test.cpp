// No operation allocates after the start: the global `operator new` counts what it is asked for.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>

#include "groundstate/runtime.hpp"

namespace {
std::atomic<long> allocations{0};
}

[[gnu::noinline]] void* operator new(std::size_t size) {
    allocations.fetch_add(1);
    if (void* memory = std::malloc(size)) {
        return memory;
    }
    throw std::bad_alloc{};
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

using namespace groundstate;

int main() {
    MonotonicClock clock;
    WaitFreeBuffer<std::int64_t, 4, MonotonicClock> latest{clock};
    LockedBuffer<std::int64_t, 2, Master::reader, MonotonicClock> swung{clock};
    MessageQueue<std::int64_t, 4, MonotonicClock> queue{clock};
    std::atomic<long> before{0};
    std::atomic<long> after{0};

    AsynchronousTask consumer{clock, "consumer", 1'000'000, [&] { return latest.available() || !queue.empty(); },
                              [&](const Cycle& cycle) {
                                  const auto sample = latest.read(cycle.watchdog);
                                  const auto frame = swung.read(cycle.watchdog);
                                  (void)queue.receive();
                              }};
    latest.wakes(consumer.trigger());
    queue.wakes(consumer.trigger());
    PeriodicTask producer{clock, "producer", {.period_ns = 1'000'000}, [&](const Cycle& cycle) {
                              if (cycle.number == 5) {
                                  before = allocations.load();
                              }
                              auto sample = latest.write(cycle.watchdog);
                              sample.publish();
                              if (auto frame = swung.write(cycle.watchdog)) {
                                  frame.publish();
                              }
                              (void)queue.send(cycle.number, cycle.watchdog);
                              if (cycle.number == 50) {
                                  after = allocations.load();
                                  after.notify_one();
                              }
                          }};
    consumer.start();
    producer.start(clock.now_ns());
    after.wait(0);
    producer.stop();
    consumer.stop();
    const std::unique_ptr<int> counted{new int{0}};
    if (allocations.load() == after) {
        std::puts("allocations are not counted");
        return EXIT_FAILURE;
    }
    std::printf("%ld allocations in 45 cycles, %ld before\n", after - before, before.load());
    return after == before ? EXIT_SUCCESS : EXIT_FAILURE;
}
