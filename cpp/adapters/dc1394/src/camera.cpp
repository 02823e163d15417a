// Opening a FireWire camera and fetching frames from its ring; see the header.
#include "groundstate/dc1394/camera.hpp"

#include <cstring>
#include <ctime>

#include <poll.h>

#include <groundstate/clock.hpp>
#include <groundstate/frame_numbers.hpp>

#include "mode.hpp"

namespace groundstate::dc1394 {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t silent_periods = 4;  // after which the camera is asked what there is

dc1394speed_t speed_of(IsoSpeed speed) {
    switch (speed) {
        case IsoSpeed::s100: return DC1394_ISO_SPEED_100;
        case IsoSpeed::s200: return DC1394_ISO_SPEED_200;
        case IsoSpeed::s400: return DC1394_ISO_SPEED_400;
        case IsoSpeed::s800: return DC1394_ISO_SPEED_800;
    }
    return DC1394_ISO_SPEED_400;
}

// The time in which the driver stamps.
std::int64_t unix_time_ns() noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return std::int64_t{now.tv_sec} * second_ns + now.tv_nsec;
}

void copy(const dc1394video_frame_t& frame, std::size_t stride_bytes, const FrameView& into) noexcept {
    const auto width = static_cast<std::size_t>(into.shape.width);
    for (int y = 0; y < into.shape.height; ++y) {
        const std::uint8_t* from = frame.image + static_cast<std::size_t>(y) * stride_bytes;
        std::uint8_t* to = into.row(y);
        if (frame.color_coding == DC1394_COLOR_CODING_YUV422) {
            // Of each two bytes one is brightness: the second in the order UYVY, the first in YUYV.
            from += frame.yuv_byte_order == DC1394_BYTE_ORDER_YUYV ? 0 : 1;
            for (std::size_t x = 0; x < width; ++x) {
                to[x] = from[2 * x];
            }
        } else if (into.shape.format == PixelFormat::bgr8) {
            for (std::size_t x = 0; x < 3 * width; x += 3) {
                to[x] = from[x + 2];
                to[x + 1] = from[x + 1];
                to[x + 2] = from[x];
            }
        } else {
            std::memcpy(to, from, into.shape.row_bytes());
        }
    }
}

}  // namespace

class Camera::State {
  public:
    explicit State(const Settings& settings)
        : settings_{settings},
          period_ns_{static_cast<std::int64_t>(1e9 / settings.frames_per_second)},
          numbers_{period_ns_} {}

    // Nothing if it went well.
    std::optional<OpenFailure> open() {
        library_.reset(dc1394_new());
        if (!library_) {
            return OpenFailure{OpenError::not_found, "libdc1394 finds no IEEE 1394 bus: is its driver loaded?"};
        }
        std::uint64_t guid = settings_.guid;
        if (auto failure = find(guid)) {
            return failure;
        }
        device_.reset(dc1394_camera_new(library_.get(), guid));
        if (!device_) {
            return OpenFailure{OpenError::busy, "the camera is on the bus and cannot be opened: another program may have "
                                                "it, or the permission for its device is missing"};
        }
        return set_up();
    }

    Grab grab(const FrameView& into, Watchdog& watchdog) noexcept {
        if (into.shape != settings_.shape || into.stride_bytes < into.shape.row_bytes()) {
            return ledger_.tell({.outcome = Outcome::other_shape});
        }
        dc1394video_frame_t* const frame = gone_ ? nullptr : await_newest(watchdog);
        if (frame == nullptr) {
            if (gone_) {
                return ledger_.tell({.outcome = Outcome::disconnected});
            }
            watchdog.skip();
            return ledger_.tell({.outcome = Outcome::timeout});
        }
        const Outcome outcome = take(*frame, into);
        give_back(frame);
        return ledger_.tell({outcome, sequence_, numbers_.stamp_ns()});
    }

    const Settings& settings() const noexcept { return settings_; }
    FrameAccount account() const noexcept { return ledger_.account(); }
    Troubles troubles() const noexcept {
        return {.full_rings = full_rings_.value(), .restarts = restarts_.value()};
    }

  private:
    // Which camera, if none was named.
    std::optional<OpenFailure> find(std::uint64_t& guid) {
        dc1394camera_list_t* all = nullptr;
        const dc1394error_t error = dc1394_camera_enumerate(library_.get(), &all);
        const List list{all};
        if (error != DC1394_SUCCESS) {
            return failure_of("looking for cameras", error);
        }
        for (std::uint32_t i = 0; i < list->num; ++i) {
            if (guid == 0 || list->ids[i].guid == guid) {
                guid = list->ids[i].guid;
                return std::nullopt;
            }
        }
        return OpenFailure{OpenError::not_found, list->num == 0 ? "there is no camera on any IEEE 1394 bus"
                                                                : "no camera on the IEEE 1394 bus has this identifier"};
    }

    std::optional<OpenFailure> set_up() {
        dc1394camera_t* const camera = device_.get();
        const auto mode = mode_of(camera, settings_.shape);
        if (const auto* failure = std::get_if<OpenFailure>(&mode)) {
            return *failure;
        }
        mode_ = *std::get_if<Mode>(&mode);
        // Speeds above 400 Mbit/s belong to 1394b.
        if (settings_.speed == IsoSpeed::s800) {
            if (const auto error = dc1394_video_set_operation_mode(camera, DC1394_OPERATION_MODE_1394B);
                error != DC1394_SUCCESS) {
                return failure_of("setting 1394b, which 800 Mbit/s need", error);
            }
        }
        if (const auto error = dc1394_video_set_iso_speed(camera, speed_of(settings_.speed)); error != DC1394_SUCCESS) {
            return failure_of("setting the speed of the bus", error);
        }
        if (const auto error = dc1394_video_set_mode(camera, mode_.mode); error != DC1394_SUCCESS) {
            return failure_of("setting the mode", error);
        }
        const auto rate = rate_of(camera, mode_, settings_.frames_per_second);
        if (const auto* failure = std::get_if<OpenFailure>(&rate)) {
            return *failure;
        }
        if (const auto error = dc1394_video_set_framerate(camera, *std::get_if<dc1394framerate_t>(&rate));
            error != DC1394_SUCCESS) {
            return failure_of("setting the rate", error);
        }
        if (const auto error = ring_.set_up(camera, settings_.dma_buffers); error != DC1394_SUCCESS) {
            return failure_of("getting DMA buffers and bandwidth", error);
        }
        if (const auto error = ring_.start(); error != DC1394_SUCCESS) {
            return failure_of("starting the transmission", error);
        }
        heard_ns_ = clock_.now_ns();
        return std::nullopt;
    }

    // The newest frame of the ring; null if the budget ended first, or the camera is gone.
    dc1394video_frame_t* await_newest(Watchdog& watchdog) noexcept {
        const std::int64_t start_ns = clock_.now_ns();
        const std::int64_t until_ns = later_ns(start_ns, watchdog.left_ns());
        dc1394video_frame_t* frame = newest();
        std::int64_t now_ns = start_ns;
        while (frame == nullptr && !gone_ && now_ns < until_ns) {
            if (wait(until_ns - now_ns)) {
                frame = newest();
            }
            now_ns = clock_.now_ns();
        }
        if (now_ns > start_ns) {
            watchdog.waited(now_ns - start_ns);
        }
        if (frame != nullptr) {
            heard_ns_ = now_ns;
        } else if (!gone_ && now_ns - heard_ns_ > silent_periods * period_ns_) {
            ask();
        }
        return frame;
    }

    // False if the time is up. A camera that hung up is gone when its last frame has been fetched.
    bool wait(std::int64_t span_ns) noexcept {
        pollfd ring{.fd = dc1394_capture_get_fileno(device_.get()), .events = POLLIN, .revents = 0};
        const timespec span{.tv_sec = static_cast<std::time_t>(span_ns / second_ns), .tv_nsec = span_ns % second_ns};
        if (ppoll(&ring, 1, &span, nullptr) <= 0) {
            return false;
        }
        gone_ = (ring.revents & POLLIN) == 0;
        return !gone_;
    }

    // Without waiting. Older frames go back as newer ones are found; each is numbered, so that it counts as lost.
    dc1394video_frame_t* newest() noexcept {
        dc1394video_frame_t* newest = nullptr;
        for (std::uint32_t i = 0; i < settings_.dma_buffers; ++i) {
            dc1394video_frame_t* next = nullptr;
            if (dc1394_capture_dequeue(device_.get(), DC1394_CAPTURE_POLICY_POLL, &next) != DC1394_SUCCESS) {
                gone_ = newest == nullptr;
                return newest;
            }
            if (next == nullptr) {
                return newest;
            }
            if (newest != nullptr) {
                give_back(newest);
            } else if (next->frames_behind + 1 >= settings_.dma_buffers) {
                full_rings_.add();
            }
            newest = next;
            number(*next);
            if (gone_) {
                return newest;
            }
        }
        return newest;
    }

    // The driver stamps in microseconds of the wall clock; a stamp that cannot be is not believed.
    void number(const dc1394video_frame_t& frame) noexcept {
        const std::int64_t age_ns = unix_time_ns() - static_cast<std::int64_t>(frame.timestamp) * 1'000;
        const std::int64_t now_ns = clock_.now_ns();
        sequence_ = numbers_.next(age_ns >= 0 && age_ns < 10 * second_ns ? now_ns - age_ns : now_ns);
    }

    Outcome take(dc1394video_frame_t& frame, const FrameView& into) noexcept {
        if (frame.image == nullptr || dc1394_capture_is_frame_corrupt(device_.get(), &frame) == DC1394_TRUE) {
            return Outcome::damaged;
        }
        const FrameShape& shape = settings_.shape;
        const std::size_t bytes = frame.color_coding == DC1394_COLOR_CODING_YUV422   ? 2
                                  : frame.color_coding == DC1394_COLOR_CODING_MONO8 ? 1
                                                                                     : 3;
        const std::size_t row_bytes = bytes * static_cast<std::size_t>(shape.width);
        const std::size_t stride_bytes = frame.stride != 0 ? frame.stride : row_bytes;
        const auto height = static_cast<std::size_t>(shape.height);
        if (frame.color_coding != mode_.coding || frame.size[0] != static_cast<std::uint32_t>(shape.width) ||
            frame.size[1] != height || stride_bytes < row_bytes) {
            return Outcome::other_shape;
        }
        if (frame.image_bytes < stride_bytes * (height - 1) + row_bytes) {
            return Outcome::damaged;
        }
        copy(frame, stride_bytes, into);
        return Outcome::frame;
    }

    void give_back(dc1394video_frame_t* frame) noexcept {
        if (dc1394_capture_enqueue(device_.get(), frame) != DC1394_SUCCESS) {
            gone_ = true;
        }
    }

    // After a silence: a camera that was reset with its bus is there and does not send.
    void ask() noexcept {
        dc1394switch_t sending = DC1394_OFF;
        if (dc1394_video_get_transmission(device_.get(), &sending) != DC1394_SUCCESS) {
            gone_ = true;
        } else if (sending == DC1394_OFF) {
            gone_ = ring_.start() != DC1394_SUCCESS;
            restarts_.add();
        }
        heard_ns_ = clock_.now_ns() - (silent_periods - 1) * period_ns_;
    }

    Settings settings_;
    std::int64_t period_ns_;
    Mode mode_{};
    MonotonicClock clock_{};
    FrameNumbers numbers_;
    FrameLedger ledger_{};
    Counter full_rings_{};
    Counter restarts_{};
    std::uint64_t sequence_ = 0;
    std::int64_t heard_ns_ = 0;
    bool gone_ = false;

    // Given back from the last to the first.
    Library library_{};
    Device device_{};
    Ring ring_{};
};

Enumeration enumerate() {
    const Library library{dc1394_new()};
    if (!library) {
        return {.failure = {OpenError::not_found, "libdc1394 finds no IEEE 1394 bus: is its driver loaded?"}};
    }
    dc1394camera_list_t* all = nullptr;
    const dc1394error_t error = dc1394_camera_enumerate(library.get(), &all);
    const List list{all};
    if (error != DC1394_SUCCESS) {
        return {.failure = failure_of("looking for cameras", error)};
    }
    Enumeration found;
    for (std::uint32_t i = 0; i < list->num; ++i) {
        const Device device{dc1394_camera_new(library.get(), list->ids[i].guid)};
        const auto word = [](const char* text) { return std::string{text != nullptr ? text : "?"}; };
        found.cameras.push_back(
            {list->ids[i].guid, device ? word(device->vendor) + " " + word(device->model) : std::string{}});
    }
    return found;
}

Opened<Camera> Camera::open(const Settings& settings) {
    if (settings.shape.width <= 0 || settings.shape.height <= 0 || !(settings.frames_per_second > 0) ||
        settings.dma_buffers < 2) {
        return OpenFailure{OpenError::refused, "a camera needs a size, a rate above 0, and two DMA buffers or more"};
    }
    auto state = std::make_unique<State>(settings);
    if (auto failure = state->open()) {
        return *std::move(failure);
    }
    return std::unique_ptr<Camera>{new Camera{std::move(state)}};
}

Camera::Camera(std::unique_ptr<State> state) noexcept : state_{std::move(state)} {}
Camera::~Camera() = default;

FrameShape Camera::shape() const noexcept { return state_->settings().shape; }
Grab Camera::grab(FrameView into, Watchdog& watchdog) noexcept { return state_->grab(into, watchdog); }
FrameAccount Camera::account() const noexcept { return state_->account(); }
Troubles Camera::troubles() const noexcept { return state_->troubles(); }

}  // namespace groundstate::dc1394
