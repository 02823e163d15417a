// Why a file or a device cannot be opened, before a library is asked that would only say no.
#pragma once

#include <cerrno>
#include <cstring>
#include <optional>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include <groundstate/frame_source.hpp>

namespace groundstate::opencv {

/// Tries to open it; nothing if that can be done.
inline std::optional<OpenFailure> why_not(const std::string& path, int flags) {
    const int file = ::open(path.c_str(), flags | O_CLOEXEC | O_NONBLOCK);
    if (file >= 0) {
        ::close(file);
        return std::nullopt;
    }
    const int error = errno;
    const std::string text = path + ": " + std::strerror(error);
    switch (error) {
        case ENOENT:
        case ENOTDIR:
        case ENODEV:
        case ENXIO: return OpenFailure{OpenError::not_found, text};
        case EACCES:
        case EPERM: return OpenFailure{OpenError::not_granted, text};
        case EBUSY: return OpenFailure{OpenError::busy, text};
        case EMFILE:
        case ENFILE:
        case ENOMEM: return OpenFailure{OpenError::no_resources, text};
        default: return OpenFailure{OpenError::driver, text};
    }
}

inline std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

inline OpenFailure other_size(const std::string& what, int width, int height, const FrameShape& asked) {
    return {OpenError::other_shape, what + " gives " + size_text(width, height) + " pixels, not the " +
                                        size_text(asked.width, asked.height) + " asked for"};
}

}  // namespace groundstate::opencv
