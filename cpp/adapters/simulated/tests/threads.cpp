// Two threads at full speed, a camera that moves, and an image that is never torn: for ThreadSanitizer.
//
// One thread draws into a swinging buffer, the other one looks at every pixel of what it reads. The brightness of the
// background tells which camera drew; a picture in which there are two of them is torn.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <groundstate/runtime.hpp>

#include <groundstate/simulated/camera.hpp>

using namespace groundstate;

namespace {

using Image = Frame<160, 120>;
using Cameras = simulated::Camera<MonotonicClock>;

Opened<Cameras> open_camera(MonotonicClock& clock, std::uint8_t background, std::atomic<double>& height) {
    simulated::Scene scene{{{.centre = {0, 0, 1}, .brightness = background}}, {}, background};
    return Cameras::open(
        clock, std::move(scene),
        [&height](std::int64_t) { return simulated::Pose{.position = {0, 0, height.load(std::memory_order_relaxed)}}; },
        {.shape = Image::shape, .period_ns = 1'000});
}

template <class B>
bool stress(const char* name) {
    MonotonicClock clock;
    B images{clock};
    std::atomic<double> height{0};
    std::atomic<bool> done{false};
    auto dark = open_camera(clock, 10, height);
    auto bright = open_camera(clock, 200, height);
    std::thread taking{[&] {
        Watchdog watchdog{10'000'000};
        for (int i = 0; !done.load(std::memory_order_relaxed); ++i) {
            watchdog.restart();
            if (auto image = images.write(watchdog)) {
                if (const Grab got = (i % 2 == 0 ? dark : bright)->grab(image->view(), watchdog)) {
                    image.publish_at(got.stamp_ns);
                }
            }
        }
    }};
    constexpr long enough = 100;
    long torn = 0;
    Watchdog watchdog{10'000'000};
    for (long looked_at = 0; looked_at < enough;) {
        watchdog.restart();
        height.store(1e-3 * static_cast<double>(looked_at), std::memory_order_relaxed);
        if (const auto image = images.read(watchdog); image && image.fresh()) {
            const auto& pixels = image->pixels;
            torn += std::any_of(pixels.begin(), pixels.end(), [&](auto pixel) { return pixel != pixels.front(); });
            ++looked_at;
        }
    }
    done.store(true, std::memory_order_relaxed);
    taking.join();
    std::printf("%s: %ld images looked at, %ld torn\n", name, enough, torn);
    return torn == 0;
}

}  // namespace

int main() {
    const bool wait_free = stress<WaitFreeBuffer<Image, 3, MonotonicClock>>("wait-free");
    const bool writer = stress<LockedBuffer<Image, 2, Master::writer, MonotonicClock>>("locked, master writes");
    const bool reader = stress<LockedBuffer<Image, 2, Master::reader, MonotonicClock>>("locked, master reads");
    return wait_free && writer && reader ? EXIT_SUCCESS : EXIT_FAILURE;
}
