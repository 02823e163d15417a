// Waiting for, dequeuing and decoding frames of a cv::VideoCapture; see the header.
#include "groundstate/opencv/capture.hpp"

#include <cmath>
#include <vector>

#include <opencv2/videoio.hpp>

#include <groundstate/clock.hpp>
#include <groundstate/frame_numbers.hpp>

#include "files.hpp"
#include "pixels.hpp"

namespace groundstate::opencv {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

std::int64_t period_ns_of(double frames_per_second) {
    return frames_per_second > 0 && frames_per_second < 1e6 ? std::llround(1e9 / frames_per_second) : 0;
}

}  // namespace

class Capture::State {
  public:
    State(cv::VideoCapture capture, const FrameShape& shape, std::int64_t period_ns, bool live)
        : shape_{shape}, period_ns_{period_ns}, live_{live}, numbers_{period_ns} {
        captures_.push_back(std::move(capture));
        ready_.reserve(1);
    }

    Grab grab(const FrameView& into, Watchdog& watchdog) noexcept {
        if (into.shape != shape_ || into.stride_bytes < into.shape.row_bytes()) {
            return ledger_.tell({.outcome = Outcome::other_shape});
        }
        if (!over_ && live_ && !await(watchdog)) {
            watchdog.skip();
            return ledger_.tell({.outcome = Outcome::timeout});
        }
        over_ = over_ || !dequeue();
        if (over_) {
            return ledger_.tell({.outcome = live_ ? Outcome::disconnected : Outcome::end_of_stream});
        }
        Outcome outcome = retrieve(into);
        // From the oldest on, as long as the age of a frame tells that the driver must hold a newer one. OpenCV gives
        // the next one only when this one is retrieved.
        for (int frames = 1; stale_ && frames < most_held && poll(0); ++frames) {
            over_ = !dequeue();
            if (over_) {
                break;  // what was retrieved is good; the next grab says that the camera is gone
            }
            outcome = retrieve(into);
        }
        return ledger_.tell({outcome, sequence_, stamp_ns_});
    }

    const FrameShape& shape() const noexcept { return shape_; }
    FrameAccount account() const noexcept { return ledger_.account(); }

  private:
    cv::VideoCapture& capture() noexcept { return captures_.front(); }

    // False if the budget ended before there was anything to dequeue, be it the end.
    bool await(Watchdog& watchdog) noexcept {
        const std::int64_t start_ns = clock_.now_ns();
        const std::int64_t until_ns = later_ns(start_ns, watchdog.left_ns());
        std::int64_t now_ns = start_ns;
        // A poll may end early: its unit is the millisecond.
        bool ready = poll(0);
        while (!ready && now_ns < until_ns) {
            ready = poll(until_ns - now_ns);
            now_ns = clock_.now_ns();
        }
        if (now_ns > start_ns) {
            watchdog.waited(now_ns - start_ns);
        }
        return ready;
    }

    // There is something to dequeue, be it the end. OpenCV waits without a bound if it is told 0, and throws if the
    // camera reports an error.
    bool poll(std::int64_t span_ns) noexcept try {
        return cv::VideoCapture::waitAny(captures_, ready_, std::max<std::int64_t>(span_ns, 1));
    } catch (const std::exception&) {
        return true;
    }

    // False if there will be no more.
    bool dequeue() noexcept try {
        if (!capture().grab()) {
            return false;
        }
        if (live_) {
            number();
        } else {
            ++sequence_;
            stamp_ns_ = static_cast<std::int64_t>(sequence_ - 1) * period_ns_;
        }
        return true;
    } catch (const std::exception&) {
        return false;
    }

    // By the driver's stamp; one that is not of the monotonic clock is not believed, and says nothing about the age.
    void number() {
        const std::int64_t now_ns = clock_.now_ns();
        const std::int64_t taken_ns = std::llround(capture().get(cv::CAP_PROP_POS_MSEC) * 1e6);
        const std::int64_t age_ns = now_ns - taken_ns;
        const bool stamped = taken_ns > 0 && age_ns >= 0 && age_ns < 10 * second_ns;
        sequence_ = numbers_.next(stamped ? taken_ns : now_ns);
        stamp_ns_ = numbers_.stamp_ns();
        stale_ = stamped && period_ns_ > 0 && age_ns > 2 * period_ns_;
    }

    Outcome retrieve(const FrameView& into) noexcept try {
        cv::Mat picture = in_place(shape_.format, arrives_as_) ? picture_of(into) : beside_;
        if (!capture().retrieve(picture) || picture.empty()) {
            return Outcome::damaged;
        }
        arrives_as_ = picture.type();
        if (!same_size(picture, shape_)) {
            return Outcome::other_shape;
        }
        if (picture.data == into.pixels) {
            return Outcome::frame;
        }
        beside_ = picture;
        return convert(picture, into) ? Outcome::frame : Outcome::other_shape;
    } catch (const std::exception&) {
        return Outcome::damaged;
    }

    // LIMIT: frames of one grab that are looked through for the newest one; a driver holds 4 for OpenCV.
    static constexpr int most_held = 8;

    std::vector<cv::VideoCapture> captures_{};  // as `waitAny` will have it: one
    std::vector<int> ready_{};
    FrameShape shape_;
    std::int64_t period_ns_;
    bool live_;
    FrameNumbers numbers_;
    MonotonicClock clock_{};
    FrameLedger ledger_{};
    cv::Mat beside_{};
    int arrives_as_ = CV_8UC3;
    std::uint64_t sequence_ = 0;
    std::int64_t stamp_ns_ = 0;
    bool stale_ = false;  // there should be a newer frame than the one dequeued last
    bool over_ = false;
};

namespace {

// What the capture says of itself.
int number_of(const cv::VideoCapture& capture, int property) {
    return static_cast<int>(std::lround(capture.get(property)));
}

}  // namespace

Opened<Capture> Capture::device(int index, const Device& settings) {
    const std::string path = "/dev/video" + std::to_string(index);
    if (auto failure = why_not(path, O_RDWR)) {
        return *std::move(failure);
    }
    cv::VideoCapture capture;
    if (!capture.open(index, cv::CAP_V4L2)) {
        return OpenFailure{OpenError::driver, path + ": Video4Linux gives no camera; somebody else may use it"};
    }
    const FrameShape& shape = settings.shape;
    capture.set(cv::CAP_PROP_FRAME_WIDTH, shape.width);
    capture.set(cv::CAP_PROP_FRAME_HEIGHT, shape.height);
    capture.set(cv::CAP_PROP_FPS, settings.frames_per_second);
    const int width = number_of(capture, cv::CAP_PROP_FRAME_WIDTH);
    const int height = number_of(capture, cv::CAP_PROP_FRAME_HEIGHT);
    if (width != shape.width || height != shape.height) {
        return other_size(path, width, height, shape);
    }
    // OpenCV starts the stream with the first frame, and waits for that one without a bound of ours: so here, once.
    // Many a camera's first frame is spoilt anyhow.
    if (!capture.grab()) {
        return OpenFailure{OpenError::driver, path + ": the camera sends nothing"};
    }
    const std::int64_t period_ns = period_ns_of(capture.get(cv::CAP_PROP_FPS));
    return std::unique_ptr<Capture>{
        new Capture{std::make_unique<State>(std::move(capture), shape, period_ns, true)}};
}

Opened<Capture> Capture::file(const std::string& path, const Video& settings) {
    if (auto failure = why_not(path, O_RDONLY)) {
        return *std::move(failure);
    }
    // Named, so that a file is read by the same library wherever there are more of them.
    cv::VideoCapture capture;
    if (!capture.open(path, cv::CAP_FFMPEG) && !capture.open(path, cv::CAP_OPENCV_MJPEG)) {
        return OpenFailure{OpenError::not_readable, path + ": no video that OpenCV can decode"};
    }
    const int width = number_of(capture, cv::CAP_PROP_FRAME_WIDTH);
    const int height = number_of(capture, cv::CAP_PROP_FRAME_HEIGHT);
    if (width != settings.shape.width || height != settings.shape.height) {
        return other_size(path, width, height, settings.shape);
    }
    std::int64_t period_ns = settings.period_ns > 0 ? settings.period_ns : period_ns_of(capture.get(cv::CAP_PROP_FPS));
    if (period_ns == 0) {
        return OpenFailure{OpenError::not_readable, path + ": does not say how many frames a second; give the period"};
    }
    return std::unique_ptr<Capture>{
        new Capture{std::make_unique<State>(std::move(capture), settings.shape, period_ns, false)}};
}

Capture::Capture(std::unique_ptr<State> state) noexcept : state_{std::move(state)} {}
Capture::~Capture() = default;

FrameShape Capture::shape() const noexcept { return state_->shape(); }
Grab Capture::grab(FrameView into, Watchdog& watchdog) noexcept { return state_->grab(into, watchdog); }
FrameAccount Capture::account() const noexcept { return state_->account(); }

}  // namespace groundstate::opencv
