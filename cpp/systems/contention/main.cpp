// The tests' system with hooks that count; every fifth plan is none, unless the variable HOOK is `none`; else it tells
// which hook fails in its cycle 20.
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "generated/contention.hpp"

namespace {

using namespace contention;

std::string failure() {
    const char* value = std::getenv("HOOK");
    return value != nullptr ? value : "";
}

struct Plans final : Planner {
    bool plan(const Cycle& cycle, const In&, Out& out) override {
        out.goals.where = static_cast<double>(cycle.number);
        out.mode.mode = static_cast<int>(cycle.number);
        return failure() == "none" || cycle.number % 5 != 4;
    }
};

struct Law final : Slow {
    bool law(const Cycle& cycle, const In& in, Out& out) override {
        const double where = in.goals ? in.goals->where : 0;
        out.position = {where, where};
        if (cycle.number == 20 && failure() == "throw") {
            throw std::runtime_error{"the law has no solution"};
        }
        if (cycle.number == 20 && failure() == "nan") {
            out.position.where = std::numeric_limits<double>::quiet_NaN();
        }
        return true;
    }
    void safe_stop() noexcept override { std::puts("stopped: slow"); }
};

struct Control final : Fast {
    bool control(const Cycle& cycle, const In& in, Out& out) override {
        if (in.position && in.position->where != in.position->again) {
            throw std::logic_error{"a torn datum"};
        }
        if (in.position && in.position.sequence < seen_) {
            throw std::logic_error{"an older datum than before"};
        }
        seen_ = in.position.sequence;
        while (cycle.number == 20 && failure() == "hang") {
            groundstate::MonotonicClock{}.sleep_until_ns(groundstate::MonotonicClock{}.now_ns() + 1'000'000);
        }
        out.state.where = in.position ? in.position->where : 0;
        return true;
    }
    void safe_stop() noexcept override { std::puts("stopped: fast"); }

  private:
    std::uint64_t seen_ = 0;
};

struct Looks final : Watcher {
    bool look(const Cycle&, const In&, Out&) override { return false; }
};

}  // namespace

int main(int count, char** words) {
    Plans planner;
    Law slow;
    Control fast;
    Looks watcher;
    return groundstate::run_program<contention::System>(count, words, contention::Hooks{planner, slow, fast, watcher});
}
