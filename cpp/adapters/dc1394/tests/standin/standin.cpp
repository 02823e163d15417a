// The library's calls over the World; see the header. Own code, after the documentation in dc1394's headers.
#include "standin.hpp"

#include <array>
#include <chrono>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

struct __dc1394_t {
    int unused = 0;
};

namespace standin {
namespace {

constexpr std::size_t most_buffers = 16;
enum class Place { free, filled, fetched };

struct Buffer {
    dc1394video_frame_t frame{};
    std::vector<std::uint8_t> pixels{};
    Place place = Place::free;
    bool corrupt = false;
};

// The bus and the one camera that can be opened.
struct Bus {
    World world{};
    __dc1394_t context{};
    dc1394camera_t camera{};
    char vendor[8] = "Standin";
    char model[8] = "Camera";
    std::array<dc1394camera_id_t, 4> ids{};
    dc1394camera_list_t list{};

    dc1394video_mode_t mode = DC1394_VIDEO_MODE_640x480_MONO8;
    bool plugged = true;
    bool sending = false;
    std::vector<Buffer> ring{};
    std::vector<std::size_t> filled{};  // from the oldest to the newest
    int read_end = -1;                  // one byte for each filled buffer: what a poll sees
    int write_end = -1;
    std::uint64_t taken = 0;
    std::int64_t begun_us = 0;
};

Bus& bus() {
    static Bus the_bus;
    return the_bus;
}

dc1394error_t may_fail() {
    World& world = bus().world;
    return ++world.calls == world.failing_call ? world.error : DC1394_SUCCESS;
}

void refuse_unless(bool right, const char* what) {
    if (!right) {
        bus().world.refusals.push_back(what);
    }
}

std::uint32_t bytes_of(dc1394color_coding_t coding) {
    return coding == DC1394_COLOR_CODING_MONO8 ? 1 : coding == DC1394_COLOR_CODING_YUV422 ? 2 : 3;
}

std::int64_t unix_us() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

void close_ring() {
    Bus& b = bus();
    for (int* end : {&b.read_end, &b.write_end}) {
        if (*end >= 0) {
            ::close(*end);
        }
        *end = -1;
    }
}

void fill(Buffer& buffer, std::uint64_t number) {
    dc1394video_frame_t& frame = buffer.frame;
    const std::uint32_t bytes = bytes_of(frame.color_coding);
    for (std::uint32_t y = 0; y < frame.size[1]; ++y) {
        for (std::uint32_t x = 0; x < frame.size[0]; ++x) {
            std::uint8_t* at = &buffer.pixels[(std::size_t{y} * frame.size[0] + x) * bytes];
            for (std::uint32_t channel = 0; channel < bytes; ++channel) {
                // UYVY: the colour first.
                at[channel] = bytes == 2 ? (channel == 1 ? pixel(number, x, y, 0) : 128) : pixel(number, x, y, channel);
            }
        }
    }
}

}  // namespace

World& world() { return bus().world; }

void begin() {
    close_ring();
    bus().~Bus();
    new (&bus()) Bus{};
    bus().begun_us = unix_us() - 5'000'000;
}

std::uint8_t pixel(std::uint64_t frame, std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
    return static_cast<std::uint8_t>(frame * 7 + x + 3 * y + 50 * channel);
}

void take(const Flaw& flaw) {
    Bus& b = bus();
    if (!b.plugged || !b.sending) {
        return;
    }
    const std::uint64_t number = ++b.taken;
    for (std::size_t i = 0; i < b.ring.size() && !flaw.lost; ++i) {
        Buffer& buffer = b.ring[i];
        if (buffer.place != Place::free) {
            continue;
        }
        dc1394video_frame_t& frame = buffer.frame;
        dc1394_get_image_size_from_video_mode(&b.camera, b.mode, &frame.size[0], &frame.size[1]);
        dc1394_get_color_coding_from_video_mode(&b.camera, b.mode, &frame.color_coding);
        fill(buffer, number);
        frame.image = buffer.pixels.data();
        frame.stride = frame.size[0] * bytes_of(frame.color_coding);
        frame.image_bytes = frame.stride * frame.size[1];
        frame.yuv_byte_order = DC1394_BYTE_ORDER_UYVY;
        frame.timestamp = flaw.no_stamp ? 0 : static_cast<std::uint64_t>(
                                                  b.begun_us + static_cast<std::int64_t>(number) * frame_us);
        if (flaw.other_size) {
            frame.size[0] /= 2;
            frame.size[1] /= 2;
        }
        if (flaw.short_data) {
            frame.image_bytes /= 2;
        }
        buffer.corrupt = flaw.corrupt;
        buffer.place = Place::filled;
        b.filled.push_back(i);
        refuse_unless(::write(b.write_end, "f", 1) == 1, "the pipe of the stand-in is full");
        return;
    }
}

void reset_bus() { bus().sending = false; }

void unplug(bool hang_up) {
    Bus& b = bus();
    b.plugged = false;
    b.sending = false;
    if (hang_up && b.write_end >= 0) {
        ::close(b.write_end);
        b.write_end = -1;
    }
}

}  // namespace standin

using namespace standin;

extern "C" {

dc1394_t* dc1394_new() {
    if (!bus().world.bus || may_fail() != DC1394_SUCCESS) {
        return nullptr;
    }
    ++bus().world.handed_out;
    return &bus().context;
}

void dc1394_free(dc1394_t* context) {
    refuse_unless(context == &bus().context, "freeing what is no context");
    refuse_unless(bus().world.handed_out == 1, "freeing the context before all else");
    --bus().world.handed_out;
}

dc1394error_t dc1394_camera_enumerate(dc1394_t*, dc1394camera_list_t** list) {
    Bus& b = bus();
    *list = nullptr;
    if (const dc1394error_t error = may_fail(); error != DC1394_SUCCESS) {
        return error;
    }
    for (std::size_t i = 0; i < b.ids.size(); ++i) {
        b.ids[i] = {.unit = 0, .guid = guid + i};
    }
    b.list = {.num = b.plugged ? b.world.cameras : 0, .ids = b.ids.data()};
    ++b.world.handed_out;
    *list = &b.list;
    return DC1394_SUCCESS;
}

void dc1394_camera_free_list(dc1394camera_list_t* list) {
    refuse_unless(list == &bus().list, "freeing what is no list");
    --bus().world.handed_out;
}

dc1394camera_t* dc1394_camera_new(dc1394_t*, std::uint64_t id) {
    Bus& b = bus();
    if (!b.plugged || id < guid || id >= guid + b.world.cameras || may_fail() != DC1394_SUCCESS) {
        return nullptr;
    }
    b.camera.guid = id;
    b.camera.vendor = b.vendor;
    b.camera.model = b.model;
    ++b.world.handed_out;
    return &b.camera;
}

void dc1394_camera_free(dc1394camera_t* camera) {
    refuse_unless(camera == &bus().camera, "freeing what is no camera");
    refuse_unless(bus().ring.empty(), "freeing a camera whose ring is still there");
    --bus().world.handed_out;
}

dc1394error_t dc1394_video_get_supported_modes(dc1394camera_t*, dc1394video_modes_t* modes) {
    const std::vector<dc1394video_mode_t>& has = bus().world.modes;
    modes->num = static_cast<std::uint32_t>(has.size());
    std::copy(has.begin(), has.end(), modes->modes);
    return may_fail();
}

dc1394error_t dc1394_get_image_size_from_video_mode(dc1394camera_t*, dc1394video_mode_t mode, std::uint32_t* width,
                                                    std::uint32_t* height) {
    switch (mode) {
        case DC1394_VIDEO_MODE_320x240_YUV422: *width = 320, *height = 240; return DC1394_SUCCESS;
        case DC1394_VIDEO_MODE_640x480_YUV422:
        case DC1394_VIDEO_MODE_640x480_RGB8:
        case DC1394_VIDEO_MODE_640x480_MONO8: *width = 640, *height = 480; return DC1394_SUCCESS;
        default: return DC1394_INVALID_VIDEO_MODE;
    }
}

dc1394error_t dc1394_get_color_coding_from_video_mode(dc1394camera_t*, dc1394video_mode_t mode,
                                                      dc1394color_coding_t* coding) {
    switch (mode) {
        case DC1394_VIDEO_MODE_320x240_YUV422:
        case DC1394_VIDEO_MODE_640x480_YUV422: *coding = DC1394_COLOR_CODING_YUV422; return DC1394_SUCCESS;
        case DC1394_VIDEO_MODE_640x480_RGB8: *coding = DC1394_COLOR_CODING_RGB8; return DC1394_SUCCESS;
        case DC1394_VIDEO_MODE_640x480_MONO8: *coding = DC1394_COLOR_CODING_MONO8; return DC1394_SUCCESS;
        default: return DC1394_INVALID_VIDEO_MODE;
    }
}

dc1394error_t dc1394_video_set_operation_mode(dc1394camera_t*, dc1394operation_mode_t) { return may_fail(); }
dc1394error_t dc1394_video_set_iso_speed(dc1394camera_t*, dc1394speed_t) { return may_fail(); }
dc1394error_t dc1394_video_set_framerate(dc1394camera_t*, dc1394framerate_t) { return may_fail(); }

dc1394error_t dc1394_video_set_mode(dc1394camera_t*, dc1394video_mode_t mode) {
    bus().mode = mode;
    return may_fail();
}

dc1394error_t dc1394_video_get_supported_framerates(dc1394camera_t*, dc1394video_mode_t, dc1394framerates_t* rates) {
    const std::vector<dc1394framerate_t>& has = bus().world.rates;
    rates->num = static_cast<std::uint32_t>(has.size());
    std::copy(has.begin(), has.end(), rates->framerates);
    return may_fail();
}

dc1394error_t dc1394_framerate_as_float(dc1394framerate_t rate, float* frames_per_second) {
    static constexpr float rates[] = {1.875f, 3.75f, 7.5f, 15, 30, 60, 120, 240};
    *frames_per_second = rates[rate - DC1394_FRAMERATE_MIN];
    return DC1394_SUCCESS;
}

dc1394error_t dc1394_capture_setup(dc1394camera_t* camera, std::uint32_t buffers, std::uint32_t) {
    Bus& b = bus();
    if (const dc1394error_t error = may_fail(); error != DC1394_SUCCESS) {
        return error;
    }
    if (buffers > most_buffers) {
        return DC1394_MEMORY_ALLOCATION_FAILURE;
    }
    refuse_unless(b.ring.empty(), "a ring is there already");
    int ends[2];
    if (::pipe2(ends, O_NONBLOCK | O_CLOEXEC) != 0) {
        return DC1394_IOCTL_FAILURE;
    }
    b.read_end = ends[0];
    b.write_end = ends[1];
    b.ring.resize(buffers);
    b.filled.reserve(buffers);
    for (std::uint32_t i = 0; i < buffers; ++i) {
        b.ring[i].frame.id = i;
        b.ring[i].frame.camera = camera;
        b.ring[i].pixels.resize(std::size_t{640} * 480 * 3);
    }
    ++b.world.handed_out;
    return DC1394_SUCCESS;
}

dc1394error_t dc1394_capture_stop(dc1394camera_t*) {
    Bus& b = bus();
    if (b.ring.empty()) {
        return DC1394_CAPTURE_IS_NOT_SET;
    }
    for (const Buffer& buffer : b.ring) {
        refuse_unless(buffer.place != Place::fetched, "the ring is given back before its frames");
    }
    b.ring.clear();
    b.filled.clear();
    close_ring();
    --b.world.handed_out;
    return DC1394_SUCCESS;
}

int dc1394_capture_get_fileno(dc1394camera_t*) { return bus().read_end; }

dc1394error_t dc1394_video_set_transmission(dc1394camera_t*, dc1394switch_t on) {
    Bus& b = bus();
    if (!b.plugged) {
        return DC1394_FAILURE;
    }
    if (on == DC1394_ON) {
        if (const dc1394error_t error = may_fail(); error != DC1394_SUCCESS) {
            return error;
        }
    }
    b.sending = on == DC1394_ON;
    return DC1394_SUCCESS;
}

dc1394error_t dc1394_video_get_transmission(dc1394camera_t*, dc1394switch_t* on) {
    *on = bus().sending ? DC1394_ON : DC1394_OFF;
    return bus().plugged ? DC1394_SUCCESS : DC1394_FAILURE;
}

dc1394error_t dc1394_capture_dequeue(dc1394camera_t*, dc1394capture_policy_t policy, dc1394video_frame_t** frame) {
    Bus& b = bus();
    *frame = nullptr;
    refuse_unless(policy == DC1394_CAPTURE_POLICY_POLL, "this would wait without a bound");
    if (b.filled.empty()) {
        return b.plugged || b.write_end >= 0 ? DC1394_SUCCESS : DC1394_IOCTL_FAILURE;
    }
    char byte = 0;
    refuse_unless(::read(b.read_end, &byte, 1) == 1, "the pipe of the stand-in is empty");
    Buffer& buffer = b.ring[b.filled.front()];
    b.filled.erase(b.filled.begin());
    buffer.place = Place::fetched;
    buffer.frame.frames_behind = static_cast<std::uint32_t>(b.filled.size());
    ++b.world.handed_out;
    *frame = &buffer.frame;
    return DC1394_SUCCESS;
}

dc1394error_t dc1394_capture_enqueue(dc1394camera_t*, dc1394video_frame_t* frame) {
    Buffer& buffer = bus().ring[frame->id];
    refuse_unless(buffer.place == Place::fetched, "giving back a frame that was not fetched");
    buffer.place = Place::free;
    --bus().world.handed_out;
    return DC1394_SUCCESS;
}

dc1394bool_t dc1394_capture_is_frame_corrupt(dc1394camera_t*, dc1394video_frame_t* frame) {
    return bus().ring[frame->id].corrupt ? DC1394_TRUE : DC1394_FALSE;
}

const char* dc1394_error_get_string(dc1394error_t error) {
    switch (error) {
        case DC1394_SUCCESS: return "Success";
        case DC1394_NO_BANDWIDTH: return "No bandwidth";
        case DC1394_INVALID_VIDEO_MODE: return "Invalid video mode";
        default: return "Generic failure";
    }
}

}  // extern "C"
