// A camera at /dev/video77 that is not there: this program's own `open`, `ioctl` and `mmap` stand before those of the C
// library and answer for it, by the documentation of Video4Linux. OpenCV's driver above them is the real one.
//
// The camera takes a frame when the test says so. Its frames are 640 × 480, BGR.
#pragma once

#include <cstdint>

namespace v4l2_standin {

inline constexpr int index = 77;
inline constexpr std::int64_t frame_us = 33'333;  // 30 a second

/// A new camera, plugged in.
void begin();

/// The camera takes a frame. Without a free buffer it is lost.
void take(bool lost = false);

/// So many frames were taken; the first ones by the camera itself, as many as the driver looks at to begin.
std::uint64_t taken();
std::uint8_t pixel(std::uint64_t frame, std::uint32_t at);

/// The cable is pulled.
void unplug();

/// Somebody else has it: it cannot be opened.
void occupy();

/// It streams no frame, and its driver says that there is an error.
void break_down();

}  // namespace v4l2_standin
