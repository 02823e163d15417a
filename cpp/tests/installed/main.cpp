// A task that runs once, and a value: the headers of both halves are there.
#include <groundstate/machine/value.hpp>
#include <groundstate/runtime.hpp>

int main() {
    groundstate::MonotonicClock clock;
    std::atomic<bool> ran{false};
    groundstate::PeriodicTask task{clock, "task", {.period_ns = 1'000'000}, [&](const groundstate::Cycle&) { ran = true; }};
    task.start(clock.now_ns());
    while (!ran) {
        clock.sleep_until_ns(clock.now_ns() + 100'000);
    }
    task.stop();
    return groundstate::machine::Value::integer(7).is_undef() ? 1 : 0;
}
