// The camera's side of Video4Linux; see the header. Own code, after the kernel's documentation.
#include "v4l2_standin.hpp"

#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace v4l2_standin {
namespace {

constexpr std::uint32_t width = 640;
constexpr std::uint32_t height = 480;
constexpr std::uint32_t bytes = width * height * 3;
constexpr std::uint32_t page = 4096;

struct Buffer {
    std::uint8_t* pixels = nullptr;
    bool queued = false;
    std::uint64_t frame = 0;  // filled with it; 0: not filled
};

struct Camera {
    bool plugged = true;
    bool occupied = false;
    bool broken = false;
    bool streaming = false;
    int handle = -1;  // as it was opened last
    int ends[2] = {-1, -1};  // one byte for each frame that can be fetched: what a poll sees
    std::vector<Buffer> buffers{};
    std::vector<std::uint32_t> filled{};
    bool told = false;  // when to take frames
    std::uint64_t taken = 0;
    std::int64_t begun_us = 0;
    std::uint32_t frames_per_second = 30;
};

Camera& camera() {
    static Camera the_camera;
    return the_camera;
}

std::int64_t now_us() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1'000;
}

int fail(int error) {
    errno = error;
    return -1;
}

void capture(bool lost) {
    Camera& c = camera();
    const std::uint64_t number = ++c.taken;
    for (std::uint32_t i = 0; i < c.buffers.size() && !lost; ++i) {
        Buffer& buffer = c.buffers[i];
        if (buffer.queued && buffer.frame == 0) {
            buffer.frame = number;
            for (std::uint32_t at = 0; at < bytes; ++at) {
                buffer.pixels[at] = pixel(number, at);
            }
            c.filled.push_back(i);
            (void)!::write(c.ends[1], "f", 1);
            return;
        }
    }
}

int dequeue(v4l2_buffer& asked) {
    Camera& c = camera();
    if (c.filled.empty() && c.streaming && c.plugged && !c.told) {
        capture(false);
    }
    if (c.filled.empty()) {
        return fail(c.plugged ? EAGAIN : ENODEV);
    }
    char byte = 0;
    (void)!::read(c.ends[0], &byte, 1);
    const std::uint32_t i = c.filled.front();
    c.filled.erase(c.filled.begin());
    Buffer& buffer = c.buffers[i];
    const std::int64_t taken_us = c.begun_us + static_cast<std::int64_t>(buffer.frame) * frame_us;
    buffer.queued = false;
    asked.index = i;
    asked.length = bytes;
    asked.bytesused = bytes;
    asked.flags = V4L2_BUF_FLAG_DONE | V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    asked.timestamp = {.tv_sec = taken_us / 1'000'000, .tv_usec = taken_us % 1'000'000};
    buffer.frame = 0;
    return 0;
}

int answer(unsigned long request, void* argument) {
    Camera& c = camera();
    if (!c.plugged && request != VIDIOC_DQBUF) {
        return fail(ENODEV);
    }
    switch (request) {
        case VIDIOC_QUERYCAP:
            static_cast<v4l2_capability*>(argument)->capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
            return 0;
        case VIDIOC_G_FMT:
        case VIDIOC_S_FMT: {
            // The only format, whatever is asked for.
            v4l2_pix_format& format = static_cast<v4l2_format*>(argument)->fmt.pix;
            format.width = width;
            format.height = height;
            format.pixelformat = V4L2_PIX_FMT_BGR24;
            format.bytesperline = width * 3;
            format.sizeimage = bytes;
            return 0;
        }
        case VIDIOC_S_PARM: return 0;
        case VIDIOC_G_PARM:
            static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {1, c.frames_per_second};
            return 0;
        case VIDIOC_REQBUFS:
            c.buffers.assign(static_cast<v4l2_requestbuffers*>(argument)->count, {});
            return 0;
        case VIDIOC_QUERYBUF: {
            auto& asked = *static_cast<v4l2_buffer*>(argument);
            asked.length = bytes;
            asked.m.offset = asked.index * page;
            return asked.index < c.buffers.size() ? 0 : fail(EINVAL);
        }
        case VIDIOC_QBUF: c.buffers.at(static_cast<v4l2_buffer*>(argument)->index).queued = true; return 0;
        case VIDIOC_DQBUF: return dequeue(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_STREAMON:
            if (c.broken) {
                return fail(EIO);
            }
            c.streaming = true;
            return 0;
        case VIDIOC_STREAMOFF: c.streaming = false; return 0;
        default: return fail(EINVAL);  // no controls, no inputs
    }
}

}  // namespace

void begin() {
    for (const int end : camera().ends) {
        if (end >= 0) {
            ::close(end);
        }
    }
    camera() = {};
    camera().begun_us = now_us() - 5'000'000;
    (void)!::pipe2(camera().ends, O_NONBLOCK | O_CLOEXEC);
}

void take(bool lost) {
    camera().told = true;
    if (camera().streaming && camera().plugged) {
        capture(lost);
    }
}

std::uint64_t taken() { return camera().taken; }

std::uint8_t pixel(std::uint64_t frame, std::uint32_t at) { return static_cast<std::uint8_t>(frame * 11 + at * 5); }

void unplug() {
    camera().plugged = false;
    ::close(camera().ends[1]);
    camera().ends[1] = -1;
}

void occupy() { camera().occupied = true; }
void break_down() { camera().broken = true; }

}  // namespace v4l2_standin

using namespace v4l2_standin;

extern "C" {

int open(const char* path, int flags, ...) {
    if (path == "/dev/video" + std::to_string(v4l2_standin::index)) {
        Camera& c = camera();
        c.handle = c.occupied ? fail(EBUSY) : c.plugged ? ::dup(c.ends[0]) : fail(ENOENT);
        return c.handle;
    }
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int ioctl(int handle, unsigned long request, ...) noexcept {
    va_list more;
    va_start(more, request);
    void* argument = va_arg(more, void*);
    va_end(more);
    if (handle >= 0 && handle == camera().handle) {
        return answer(request, argument);
    }
    return static_cast<int>(syscall(SYS_ioctl, handle, request, argument));
}

void* mmap(void* address, std::size_t length, int protection, int flags, int handle, off_t offset) noexcept {
    const bool ours = handle >= 0 && handle == camera().handle;
    constexpr int anonymous = MAP_PRIVATE | MAP_ANONYMOUS;
    const long memory = ours ? syscall(SYS_mmap, nullptr, length, PROT_READ | PROT_WRITE, anonymous, -1, 0)
                             : syscall(SYS_mmap, address, length, protection, flags, handle, offset);
    void* const result = reinterpret_cast<void*>(memory);
    if (ours && result != MAP_FAILED) {
        camera().buffers.at(static_cast<std::size_t>(offset) / page).pixels = static_cast<std::uint8_t*>(result);
    }
    return result;
}

}  // extern "C"
