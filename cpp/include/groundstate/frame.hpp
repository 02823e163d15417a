// Images in memory that belongs to the caller.
//
// A Frame is the array of a swinging buffer: its size and format are part of its type, so it needs no allocation and no
// pointer. A FrameView shows a camera such memory, or any other: where the pixels begin, how far one row lies from the
// next, and what shape they have. Neither knows a camera or an image library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace groundstate {

/// What a pixel consists of: one byte of brightness, or three bytes in the named order.
enum class PixelFormat : std::uint8_t { mono8, bgr8, rgb8 };

constexpr int bytes_per_pixel(PixelFormat format) noexcept { return format == PixelFormat::mono8 ? 1 : 3; }

/// The size and format of an image.
struct FrameShape {
    int width = 0;
    int height = 0;
    PixelFormat format = PixelFormat::mono8;

    constexpr std::size_t row_bytes() const noexcept {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(bytes_per_pixel(format));
    }
    friend constexpr bool operator==(const FrameShape&, const FrameShape&) noexcept = default;
};

/// Pixels in the caller's memory; `Byte` is `std::uint8_t` or `const std::uint8_t`. Rows go from top to bottom.
template <class Byte>
struct BasicFrameView {
    Byte* pixels = nullptr;
    FrameShape shape{};
    std::size_t stride_bytes = 0;  ///< from the beginning of one row to that of the next

    constexpr Byte* row(int y) const noexcept { return pixels + static_cast<std::size_t>(y) * stride_bytes; }

    /// It can be read through, too.
    constexpr operator BasicFrameView<const std::uint8_t>() const noexcept { return {pixels, shape, stride_bytes}; }
};

using FrameView = BasicFrameView<std::uint8_t>;
using ConstFrameView = BasicFrameView<const std::uint8_t>;

/// An image whose memory is its own.
template <int Width, int Height, PixelFormat Format = PixelFormat::mono8>
struct Frame {
    static_assert(Width > 0 && Height > 0);
    static constexpr FrameShape shape{Width, Height, Format};

    FrameView view() noexcept { return {pixels.data(), shape, shape.row_bytes()}; }
    ConstFrameView view() const noexcept { return {pixels.data(), shape, shape.row_bytes()}; }

    alignas(64) std::array<std::uint8_t, shape.row_bytes() * Height> pixels{};
};

}  // namespace groundstate
