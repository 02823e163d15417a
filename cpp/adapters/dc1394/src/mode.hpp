// Which of a camera's modes and rates is the one that was asked for.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <variant>

#include "session.hpp"

namespace groundstate::dc1394 {

/// A mode of a camera, and what its pixels are.
struct Mode {
    dc1394video_mode_t mode = DC1394_VIDEO_MODE_MIN;
    dc1394color_coding_t coding = DC1394_COLOR_CODING_MONO8;
};

/// The codings that a format can be made of, the best one first.
inline std::array<dc1394color_coding_t, 2> codings_of(PixelFormat format) {
    return format == PixelFormat::mono8
               ? std::array{DC1394_COLOR_CODING_MONO8, DC1394_COLOR_CODING_YUV422}
               : std::array{DC1394_COLOR_CODING_RGB8, DC1394_COLOR_CODING_RGB8};
}

inline const char* text(dc1394color_coding_t coding) {
    switch (coding) {
        case DC1394_COLOR_CODING_MONO8: return "MONO8";
        case DC1394_COLOR_CODING_YUV411: return "YUV411";
        case DC1394_COLOR_CODING_YUV422: return "YUV422";
        case DC1394_COLOR_CODING_YUV444: return "YUV444";
        case DC1394_COLOR_CODING_RGB8: return "RGB8";
        case DC1394_COLOR_CODING_MONO16: return "MONO16";
        default: return "another coding";
    }
}

/// The camera's mode of that shape, or why there is none.
inline std::variant<Mode, OpenFailure> mode_of(dc1394camera_t* camera, const FrameShape& shape) {
    dc1394video_modes_t modes{};
    if (const auto error = dc1394_video_get_supported_modes(camera, &modes); error != DC1394_SUCCESS) {
        return failure_of("asking the camera for its modes", error);
    }
    std::optional<Mode> found;
    std::size_t rank = codings_of(shape.format).size();
    std::string others;
    for (std::uint32_t i = 0; i < modes.num; ++i) {
        Mode mode{.mode = modes.modes[i]};
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        if (mode.mode >= DC1394_VIDEO_MODE_EXIF ||
            dc1394_get_image_size_from_video_mode(camera, mode.mode, &width, &height) != DC1394_SUCCESS ||
            dc1394_get_color_coding_from_video_mode(camera, mode.mode, &mode.coding) != DC1394_SUCCESS) {
            continue;
        }
        others += (others.empty() ? "" : ", ") + std::to_string(width) + " x " + std::to_string(height) + " " +
                  text(mode.coding);
        if (width != static_cast<std::uint32_t>(shape.width) || height != static_cast<std::uint32_t>(shape.height)) {
            continue;
        }
        const auto codings = codings_of(shape.format);
        for (std::size_t better = 0; better < rank; ++better) {
            if (codings[better] == mode.coding) {
                found = mode;
                rank = better;
            }
        }
    }
    if (found) {
        return *found;
    }
    return OpenFailure{OpenError::refused, "the camera has no mode of " + std::to_string(shape.width) + " x " +
                                               std::to_string(shape.height) + " " +
                                               text(codings_of(shape.format).front()) +
                                               (others.empty() ? ", and no other of a fixed size" : "; it has " + others)};
}

/// The camera's rate of so many frames a second in that mode, or why there is none.
inline std::variant<dc1394framerate_t, OpenFailure> rate_of(dc1394camera_t* camera, const Mode& mode, double asked) {
    dc1394framerates_t rates{};
    if (const auto error = dc1394_video_get_supported_framerates(camera, mode.mode, &rates); error != DC1394_SUCCESS) {
        return failure_of("asking the camera for its rates", error);
    }
    std::string others;
    for (std::uint32_t i = 0; i < rates.num; ++i) {
        float rate = 0;
        if (dc1394_framerate_as_float(rates.framerates[i], &rate) != DC1394_SUCCESS) {
            continue;
        }
        if (std::abs(static_cast<double>(rate) - asked) < 1e-3) {
            return rates.framerates[i];
        }
        others += (others.empty() ? "" : ", ") + std::to_string(rate);
    }
    return OpenFailure{OpenError::refused,
                       "the camera does not take " + std::to_string(asked) + " frames a second in this mode" +
                           (others.empty() ? "" : "; it takes " + others)};
}

}  // namespace groundstate::dc1394
