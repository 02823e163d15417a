// Images in files, one a frame, as a recording: whatever OpenCV decodes, in the order given.
//
// A file that is missing, cut off or no image is a damaged frame, one of another size is said to be so, and the
// recording goes on with the next: cv::VideoCapture would end there in silence.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <groundstate/frame_source.hpp>

namespace groundstate::opencv {

/// A recording in files.
struct Images {
    FrameShape shape{640, 480, PixelFormat::bgr8};
    std::int64_t period_ns = 40'000'000;            ///< from frame to frame; the first one's stamp is 0
};

/// The files named by a pattern with one `%d`, as printf has it (`image.%04d.png`), for all numbers from first to last.
/// Throws: std::invalid_argument if the pattern is another one.
std::vector<std::string> numbered(const std::string& pattern, int first, int last);

/// A FrameSource of image files.
class ImageSequence {
  public:
    /// Looks at the first file.
    /// Who: the owner. Blocks: as the disk does. Allocates: yes.
    /// Errors: not_found, not_granted, not_readable, other_shape, refused (no files, or no period).
    static Opened<ImageSequence> open(std::vector<std::string> paths, const Images& settings = {});

    ImageSequence(const ImageSequence&) = delete;
    ImageSequence& operator=(const ImageSequence&) = delete;
    ~ImageSequence();

    FrameShape shape() const noexcept;

    /// Who: the one that grabs. Blocks: as long as the disk takes. Allocates: within OpenCV's decoders.
    /// Worst case: one file read, decoded and copied or converted into the caller's memory.
    Grab grab(FrameView into, Watchdog& watchdog) noexcept;

    /// Who: everybody. Blocks: no.
    FrameAccount account() const noexcept;

  private:
    class State;
    explicit ImageSequence(std::unique_ptr<State> state) noexcept;

    std::unique_ptr<State> state_;
};

static_assert(FrameSource<ImageSequence>);

}  // namespace groundstate::opencv
