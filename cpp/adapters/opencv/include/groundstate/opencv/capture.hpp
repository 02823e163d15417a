// cv::VideoCapture as a source of images: a camera of the machine, or a video file.
//
// A camera goes through Video4Linux, whose driver can be waited for with a bound. It gives the newest frame that its
// driver holds; the driver's stamps tell which were lost. A file gives each of its frames, stamped by its rate; reading
// and decoding take as long as they take, and are not waiting.
#pragma once

#include <memory>
#include <string>

#include <groundstate/frame_source.hpp>

namespace groundstate::opencv {

/// What a camera is asked for.
struct Device {
    FrameShape shape{640, 480, PixelFormat::bgr8};
    double frames_per_second = 30;  ///< the nearest rate that it has is taken
};

/// What a file is expected to hold.
struct Video {
    FrameShape shape{640, 480, PixelFormat::bgr8};
    std::int64_t period_ns = 0;  ///< from frame to frame; 0: as the file says
};

/// A FrameSource of a cv::VideoCapture.
class Capture {
  public:
    /// Opens /dev/video<index> and starts it; the frame that this takes is not delivered.
    /// Who: the owner. Blocks: as the driver does, some 100 ms; 10 s if the camera sends nothing. Allocates: yes.
    /// Errors: not_found, not_granted, busy, other_shape, driver.
    static Opened<Capture> device(int index, const Device& settings = {});

    /// Opens a video file by FFmpeg, or Motion JPEG by OpenCV itself; the format, but not the size, is converted to the
    /// one asked for.
    /// Who: the owner. Blocks: as the disk does. Allocates: yes.
    /// Errors: not_found, not_granted, not_readable, other_shape.
    static Opened<Capture> file(const std::string& path, const Video& settings = {});

    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;
    ~Capture();

    FrameShape shape() const noexcept;

    /// Who: the one that grabs. Blocks: a camera ≤ budget, in whole milliseconds; a file as long as the disk takes.
    /// Allocates: within OpenCV and its decoders. Worst case: one frame decoded into the caller's memory, in another
    /// format than the driver's then converted; of a camera whose task is late as many as its driver holds.
    /// LIMIT: a frame that the decoder mends is not known to be damaged.
    Grab grab(FrameView into, Watchdog& watchdog) noexcept;

    /// Who: everybody. Blocks: no.
    FrameAccount account() const noexcept;

  private:
    class State;
    explicit Capture(std::unique_ptr<State> state) noexcept;

    std::unique_ptr<State> state_;
};

static_assert(FrameSource<Capture>);

}  // namespace groundstate::opencv
