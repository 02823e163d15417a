// What a simulated frame costs: 640 × 480, four discs, a camera that moves.
//
//     simulated_frame [FRAMES]     so many for each line; 5 000 unless given
//
// Figures are printed and judged by people.
#include <cstdio>
#include <cstdlib>

#include <groundstate/virtual_clock.hpp>

#include "four_discs.hpp"

using namespace groundstate;

namespace {

using Image = Frame<640, 480>;

void line(const char* name, const simulated::Faults& faults, std::size_t frames) {
    VirtualClock time;
    const MonotonicClock stopwatch;
    const auto approach = [](std::int64_t taken_ns) {
        return simulated::Pose{.position = {0, 0, 1e-12 * static_cast<double>(taken_ns % 500'000'000'000)}};
    };
    auto camera = simulated::Camera<VirtualClock>::open(time, simulated::four_discs(), approach, {.faults = faults});
    std::vector<Image> images(3);
    std::vector<std::int64_t> spent_ns;
    for (std::size_t i = 0; i < frames; ++i) {
        Watchdog watchdog{0};
        time.sleep_until_ns(static_cast<std::int64_t>(i) * 10'000'000);
        const std::int64_t start_ns = stopwatch.now_ns();
        (void)camera->grab(images[i % images.size()].view(), watchdog);
        spent_ns.push_back(stopwatch.now_ns() - start_ns);
    }
    std::sort(spent_ns.begin(), spent_ns.end());
    const auto us = [&](std::size_t percent) {
        return static_cast<double>(spent_ns[(spent_ns.size() - 1) * percent / 100]) * 1e-3;
    };
    std::printf("%-28s %8.1f %8.1f %8.1f\n", name, us(50), us(99), us(100));
}

}  // namespace

int main(int count, char** arguments) {
    const std::size_t frames = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 5'000;
    std::printf("simulated 640 x 480, us:          p50      p99      max\n");
    line("four discs", {}, frames);
    line("... one of them covered", {.occluded = 1}, frames);
    line("... noise", {.noise = 3}, frames);
    line("... blur", {.blur = 0.8}, frames);
    line("... all of it", {.occluded = 0.1, .noise = 3, .blur = 0.8}, frames);
}
