// What libdc1394 gives and has to get back, each owned by an object: library, camera, ring and transmission.
//
// They are made in this order, and given back in the opposite one on every path. Also owns what an error of the library
// means here.
#pragma once

#include <memory>
#include <string>

#include <dc1394/dc1394.h>

#include <groundstate/frame_source.hpp>

namespace groundstate::dc1394 {

/// What failed, with the library's own word for it.
inline OpenFailure failure_of(const std::string& what, dc1394error_t error) {
    const std::string text = what + ": " + dc1394_error_get_string(error);
    switch (error) {
        case DC1394_NO_BANDWIDTH:
        case DC1394_NO_ISO_CHANNEL:
        case DC1394_MEMORY_ALLOCATION_FAILURE: return {OpenError::no_resources, text};
        case DC1394_CAPTURE_IS_RUNNING: return {OpenError::busy, text};
        case DC1394_NOT_A_CAMERA: return {OpenError::not_found, text};
        case DC1394_FUNCTION_NOT_SUPPORTED:
        case DC1394_REQ_VALUE_OUTSIDE_RANGE:
        case DC1394_INVALID_VIDEO_FORMAT:
        case DC1394_INVALID_VIDEO_MODE:
        case DC1394_INVALID_FRAMERATE:
        case DC1394_INVALID_ISO_SPEED:
        case DC1394_INVALID_OPERATION_MODE:
        case DC1394_INVALID_COLOR_CODING: return {OpenError::refused, text};
        default: return {OpenError::driver, text};
    }
}

struct GiveBack {
    void operator()(dc1394_t* library) const noexcept { dc1394_free(library); }
    void operator()(dc1394camera_list_t* list) const noexcept { dc1394_camera_free_list(list); }
    void operator()(dc1394camera_t* camera) const noexcept { dc1394_camera_free(camera); }
};

using Library = std::unique_ptr<dc1394_t, GiveBack>;
using List = std::unique_ptr<dc1394camera_list_t, GiveBack>;
using Device = std::unique_ptr<dc1394camera_t, GiveBack>;

/// The ring of DMA buffers, and what has been begun with it.
class Ring {
  public:
    Ring() noexcept = default;
    Ring(const Ring&) = delete;
    Ring& operator=(const Ring&) = delete;
    ~Ring() {
        if (sending_) {
            dc1394_video_set_transmission(camera_, DC1394_OFF);
        }
        if (camera_ != nullptr) {
            dc1394_capture_stop(camera_);
        }
    }

    dc1394error_t set_up(dc1394camera_t* camera, std::uint32_t buffers) {
        const dc1394error_t error = dc1394_capture_setup(camera, buffers, DC1394_CAPTURE_FLAGS_DEFAULT);
        camera_ = error == DC1394_SUCCESS ? camera : nullptr;
        return error;
    }

    dc1394error_t start() {
        const dc1394error_t error = dc1394_video_set_transmission(camera_, DC1394_ON);
        sending_ = error == DC1394_SUCCESS;
        return error;
    }

  private:
    dc1394camera_t* camera_ = nullptr;
    bool sending_ = false;
};

}  // namespace groundstate::dc1394
