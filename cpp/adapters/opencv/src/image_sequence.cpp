// Reading and decoding image files; see the header.
#include "groundstate/opencv/image_sequence.hpp"

#include <array>
#include <cstdio>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "files.hpp"
#include "pixels.hpp"

namespace groundstate::opencv {
namespace {

// The file's bytes, in memory that is kept from one to the next. Empty if it cannot be read.
void read(const std::string& path, std::vector<std::uint8_t>& bytes) {
    bytes.clear();
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{std::fopen(path.c_str(), "rbe"), &std::fclose};
    if (!file) {
        return;
    }
    for (std::size_t got = 1; got != 0;) {
        const std::size_t size = bytes.size();
        bytes.resize(std::max(bytes.capacity(), size + (std::size_t{1} << 16)));
        got = std::fread(bytes.data() + size, 1, bytes.size() - size, file.get());
        bytes.resize(size + got);
    }
}

int decoding_of(PixelFormat format) {
    return cv::IMREAD_IGNORE_ORIENTATION | (format == PixelFormat::mono8 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
}

}  // namespace

std::vector<std::string> numbered(const std::string& pattern, int first, int last) {
    // One %d, perhaps with digits: nothing else may reach printf.
    const std::size_t begin = pattern.find('%');
    const std::size_t end = begin == std::string::npos ? begin : pattern.find_first_not_of("0123456789", begin + 1);
    if (end == std::string::npos || pattern[end] != 'd' || pattern.find('%', end) != std::string::npos ||
        end - begin > 3) {
        throw std::invalid_argument{"a pattern of files has one %d in it, as in image.%04d.png: " + pattern};
    }
    const std::string conversion = pattern.substr(begin, end + 1 - begin);
    std::vector<std::string> paths;
    for (int number = first; number <= last; ++number) {
        std::array<char, 128> digits{};
        std::snprintf(digits.data(), digits.size(), conversion.c_str(), number);
        paths.push_back(pattern.substr(0, begin) + digits.data() + pattern.substr(end + 1));
    }
    return paths;
}

class ImageSequence::State {
  public:
    State(std::vector<std::string> paths, const Images& settings) : paths_{std::move(paths)}, settings_{settings} {}

    // What the next file holds, into the view.
    Outcome load(const FrameView& into) noexcept try {
        read(paths_[next_], bytes_);
        if (bytes_.empty()) {
            return Outcome::damaged;
        }
        // Not into the caller's memory: an image that cannot be decoded would leave it as it was, without a word.
        const cv::Mat picture = cv::imdecode(bytes_, decoding_of(settings_.shape.format));
        if (picture.empty()) {
            return Outcome::damaged;
        }
        if (!same_size(picture, settings_.shape)) {
            found_ = picture.size();
            return Outcome::other_shape;
        }
        return convert(picture, into) ? Outcome::frame : Outcome::other_shape;
    } catch (const std::exception&) {
        return Outcome::damaged;
    }

    Grab grab(const FrameView& into) noexcept {
        if (into.shape != settings_.shape || into.stride_bytes < into.shape.row_bytes()) {
            return ledger_.tell({.outcome = Outcome::other_shape});
        }
        if (next_ == paths_.size()) {
            return ledger_.tell({.outcome = Outcome::end_of_stream});
        }
        const Outcome outcome = load(into);
        ++next_;
        return ledger_.tell({outcome, next_, static_cast<std::int64_t>(next_ - 1) * settings_.period_ns});
    }

    const Images& settings() const noexcept { return settings_; }
    FrameAccount account() const noexcept { return ledger_.account(); }
    const cv::Size& found() const noexcept { return found_; }

  private:
    std::vector<std::string> paths_;
    Images settings_;
    std::size_t next_ = 0;
    std::vector<std::uint8_t> bytes_{};
    cv::Size found_{};
    FrameLedger ledger_{};
};

Opened<ImageSequence> ImageSequence::open(std::vector<std::string> paths, const Images& settings) {
    const FrameShape& shape = settings.shape;
    if (paths.empty() || settings.period_ns <= 0 || shape.width <= 0 || shape.height <= 0) {
        return OpenFailure{OpenError::refused, "an image sequence needs a file, a period above 0, and a size"};
    }
    const std::string first = paths.front();
    if (auto failure = why_not(first, O_RDONLY)) {
        return *std::move(failure);
    }
    auto state = std::make_unique<State>(std::move(paths), settings);
    std::vector<std::uint8_t> memory(shape.row_bytes() * static_cast<std::size_t>(shape.height));
    switch (state->load({memory.data(), shape, shape.row_bytes()})) {
        case Outcome::frame: break;
        case Outcome::other_shape: return other_size(first, state->found().width, state->found().height, shape);
        default: return OpenFailure{OpenError::not_readable, first + ": no image that OpenCV can decode"};
    }
    return std::unique_ptr<ImageSequence>{new ImageSequence{std::move(state)}};
}

ImageSequence::ImageSequence(std::unique_ptr<State> state) noexcept : state_{std::move(state)} {}
ImageSequence::~ImageSequence() = default;

FrameShape ImageSequence::shape() const noexcept { return state_->settings().shape; }
Grab ImageSequence::grab(FrameView into, Watchdog&) noexcept { return state_->grab(into); }
FrameAccount ImageSequence::account() const noexcept { return state_->account(); }

}  // namespace groundstate::opencv
