// A FireWire camera (IEEE 1394, IIDC) by libdc1394 as a source of images.
//
// The camera writes into a ring of DMA buffers by itself. A grab takes the newest of them, copies its rows into the
// caller's memory, and gives all of them back; those passed over, and those that the camera took while the ring was
// full, are lost, and counted by the stamps of the driver.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <groundstate/frame_source.hpp>

namespace groundstate::dc1394 {

/// A camera that is on a bus.
struct Identity {
    std::uint64_t guid = 0;
    std::string name{};  ///< vendor and model, if it can be opened
};

/// All cameras on all buses, or why they cannot be told.
struct Enumeration {
    std::vector<Identity> cameras{};
    OpenFailure failure{};  ///< with a text if there is one
};

/// Who: the owner. Blocks: for as long as the buses take. Allocates: yes.
Enumeration enumerate();

/// How fast the camera may send over the bus, in Mbit/s.
enum class IsoSpeed { s100, s200, s400, s800 };

/// What the camera is asked for.
struct Settings {
    std::uint64_t guid = 0;  ///< which one; 0: the first that is found
    /// mono8 is a camera's MONO8 mode, or the brightness out of YUV422; bgr8 and rgb8 are its RGB8 mode.
    /// LIMIT: the modes of fixed size; none of Format 7.
    FrameShape shape{640, 480, PixelFormat::mono8};
    double frames_per_second = 30;  ///< exactly one of those that the mode has
    IsoSpeed speed = IsoSpeed::s400;
    std::uint32_t dma_buffers = 4;
};

/// What is known of a camera's troubles, beside its account; each number is whole.
struct Troubles {
    std::int64_t full_rings = 0;  ///< grabs that found every DMA buffer full
    std::int64_t restarts = 0;    ///< transmissions begun anew, as after a bus reset
};

/// A FrameSource of one camera.
class Camera {
  public:
    /// Sets speed, mode and rate, gets the ring, and starts the transmission. When it fails all is given back.
    /// Who: the owner. Blocks: for some 100 ms, as the bus does. Allocates: yes.
    /// Errors: not_found (no bus, or no such camera), busy, refused (no such mode, rate or speed), no_resources
    /// (bandwidth, channels, memory), driver.
    static Opened<Camera> open(const Settings& settings = {});

    Camera(const Camera&) = delete;
    Camera& operator=(const Camera&) = delete;
    ~Camera();

    FrameShape shape() const noexcept;

    /// Who: the one that grabs. Blocks: ≤ budget. Allocates: no.
    /// Worst case: one frame copied, and as many system calls as there are DMA buffers. When four periods have passed in
    /// silence, the camera is asked over the bus whether it is still there and sending, once a period.
    Grab grab(FrameView into, Watchdog& watchdog) noexcept;

    /// Who: everybody. Blocks: no.
    FrameAccount account() const noexcept;
    Troubles troubles() const noexcept;

  private:
    class State;
    explicit Camera(std::unique_ptr<State> state) noexcept;

    std::unique_ptr<State> state_;
};

static_assert(FrameSource<Camera>);

}  // namespace groundstate::dc1394
