// A stand-in for libdc1394 with a bus, a camera and its faults, to be linked in its place.
//
// It implements the calls that the adapter makes, by their documentation, over a World that a test sets up. Nothing
// happens by itself and nothing takes time: the camera takes a frame when the test says so. What the library hands out
// is counted until it comes back.
#pragma once

#include <cstdint>
#include <vector>

#include <dc1394/dc1394.h>

namespace standin {

inline constexpr std::uint64_t guid = 0x0814436100001234;
inline constexpr std::int64_t frame_us = 33'333;  // 30 a second

/// What the library finds, and what it is to do.
struct World {
    bool bus = true;
    std::uint32_t cameras = 1;
    std::vector<dc1394video_mode_t> modes{DC1394_VIDEO_MODE_640x480_YUV422, DC1394_VIDEO_MODE_640x480_RGB8,
                                          DC1394_VIDEO_MODE_640x480_MONO8, DC1394_VIDEO_MODE_FORMAT7_0};
    std::vector<dc1394framerate_t> rates{DC1394_FRAMERATE_15, DC1394_FRAMERATE_30};

    /// The call of this number that can fail does, from 1 on; 0: none. So a test can let each of them fail in turn.
    int failing_call = 0;
    dc1394error_t error = DC1394_FAILURE;

    int calls = 0;       ///< so far, of those that can fail while a camera is opened
    int handed_out = 0;  ///< contexts, lists, cameras, rings and frames that have not come back
    std::vector<const char*> refusals{};  ///< misuse of the library: to be empty
};

World& world();

/// A new world, with nothing in it from before.
void begin();

/// What is wrong with a frame.
struct Flaw {
    bool lost = false;         ///< taken, and not in the ring
    bool corrupt = false;      ///< the library knows
    bool short_data = false;   ///< the library does not
    bool other_size = false;   ///< as of a camera whose mode somebody else has set
    bool no_stamp = false;
};

/// The camera takes a frame, if it is sending; without a free buffer it is lost. Pixel (x, y) of frame n of a channel is
/// `pixel(n, x, y, channel)`.
void take(const Flaw& flaw = {});
std::uint8_t pixel(std::uint64_t frame, std::uint32_t x, std::uint32_t y, std::uint32_t channel);

/// The bus is reset: the camera is still there, and no longer sends.
void reset_bus();

/// The cable is pulled: the ring's file hangs up, or stays silent; nothing is answered over the bus.
void unplug(bool hang_up = true);

}  // namespace standin
