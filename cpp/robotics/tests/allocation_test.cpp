// A control step allocates nothing: tracking, law, depths, kinematics. `operator new` and `malloc` count; Eigen and OpenCV
// use the latter.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>


#include "groundstate/kinematics/joint_velocities.hpp"
#include "groundstate/servo/visual_servo.hpp"
#include "groundstate/vision/disc_tracker.hpp"

namespace {
std::atomic<long> allocations{0};
}

// All ways to memory go through these; glibc's own are called under their other names.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    return __libc_realloc(memory, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    *memory = __libc_memalign(alignment, size);
    return *memory == nullptr;
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    return __libc_memalign(alignment, size);
}
}

using namespace groundstate;

int main() {
    constexpr int width = 640;
    constexpr int height = 480;
    const servo::Intrinsics camera{.fx = 600, .fy = 600, .cx = 319.5, .cy = 239.5};
    std::vector<std::uint8_t> pixels(width * height);
    vision::DiscTracker tracker{width, height, {.discs = {.dark = false}}};
    kinematics::Arm arm{kinematics::example_arm()};
    kinematics::Joints q;
    q << 0.1, 1.2, -1.9, 0.2, -0.8, 0.1;

    servo::View desired;
    desired.seen = {{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}};
    desired.depths.fill(0.5);
    long tracked = 0;
    long in_steps = 0;
    double sum = 0;
    for (int step = 0; step < 50; ++step) {
        std::fill(pixels.begin(), pixels.end(), std::uint8_t{40});
        for (std::size_t i = 0; i < servo::points; ++i) {
            const servo::Pixel at = camera.pixel({desired.seen[i].x * 1.2 + 0.001 * step, desired.seen[i].y});
            for (int v = 0; v < height; ++v) {
                for (int u = 0; u < width; ++u) {
                    if (std::hypot(u - at.u, v - at.v) < 14) {
                        pixels[static_cast<std::size_t>(v * width + u)] = 230;
                    }
                }
            }
        }
        const long before = allocations.load();
        const vision::Tracked& seen =
            tracker.look({pixels.data(), {width, height, PixelFormat::mono8}, width}, step * 10'000'000);
        if (seen) {
            servo::View present{servo::normalised(camera, seen.pixels), {}};
            present.depths = servo::depths_by_area(present.seen, desired);
            const servo::Command command = servo::control({}, present, desired);
            const auto velocities = kinematics::joint_velocities(arm.model().limits, {}, arm.jacobian(q), q, command.twist);
            q += 0.01 * velocities.velocity;
            sum += command.error;
        }
        // The first step searches the whole image.
        if (step > 0) {
            tracked += seen.track == vision::Track::tracking;
            in_steps += allocations.load() - before;
        }
    }
    const long before = allocations.load();
    std::vector<int> counted(3);
    const bool counts = allocations.load() > before && counted.size() == 3;
    std::printf("%ld allocations in %ld steps, %ld before; mean error %.3f\n", in_steps, tracked, before, sum / 50);
    return counts && tracked == 49 && in_steps == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
