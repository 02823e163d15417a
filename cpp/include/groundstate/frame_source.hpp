// Where images come from: the one concept for every camera, recording and simulation.
//
// A source is opened with a shape, and from then on fills memory of that shape, in place. The memory is the caller's;
// in a robot it is the array of a swinging buffer. The outcome of a grab is a value, not an exception: the world fails
// in these ways and in no others. The sources themselves are the adapters (../../../adapters); this file knows no
// library.
//
// The conformance suite (adapters/conformance) tests what holds for every source:
//   ordered     the numbers of frames rise, their stamps never go back;
//   accounted   number of a frame = frames delivered + frames lost, at the moment of its delivery;
//   whole       after anything but `frame` the memory's content means nothing, and nothing beside it was written;
//   final       after `end_of_stream` or `disconnected` every later grab says the same, at once.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "frame.hpp"
#include "watchdog.hpp"

namespace groundstate {

/// What became of a grab.
enum class Outcome : std::uint8_t {
    frame,          ///< a whole new frame is in the memory
    timeout,        ///< the watchdog's budget ended before a frame came; the skip is counted
    damaged,        ///< a frame came and is not whole; it is lost, the next may be good
    other_shape,    ///< the frame that came, or the memory given, is not of the source's shape
    end_of_stream,  ///< the recording is over
    disconnected,   ///< the camera is gone
};

constexpr const char* text(Outcome outcome) noexcept {
    switch (outcome) {
        case Outcome::frame: return "frame";
        case Outcome::timeout: return "no frame in time";
        case Outcome::damaged: return "a damaged frame";
        case Outcome::other_shape: return "a frame of another size or format";
        case Outcome::end_of_stream: return "the end of the recording";
        case Outcome::disconnected: return "the camera is disconnected";
    }
    return "";
}

/// What a grab gave. Number, stamp and losses are those of the frame, and 0 if there is none.
struct [[nodiscard]] Grab {
    Outcome outcome = Outcome::timeout;
    std::uint64_t sequence = 0;  ///< its number, from 1 on, among all that the camera has taken since it was opened
    std::int64_t stamp_ns = 0;   ///< when it was taken, by the source's clock; not when it was fetched
    std::uint64_t lost = 0;      ///< frames taken between the one delivered before and this one, and not delivered

    explicit operator bool() const noexcept { return outcome == Outcome::frame; }
};

/// The outcomes of all frames, and of all grabs without one; each number is whole.
struct FrameAccount {
    std::int64_t delivered = 0;    ///< frames given to the caller
    std::int64_t lost = 0;         ///< frames taken and not given, for whatever reason
    std::int64_t damaged = 0;      ///< grabs that said `damaged`; their frames are among the lost
    std::int64_t other_shape = 0;  ///< grabs that said `other_shape`
    std::int64_t timeouts = 0;     ///< grabs that said `timeout`
};

/// The counters of a FrameAccount. Who: `tell` the one thread that grabs, `account` any thread.
class FrameLedger {
  public:
    /// Counts a grab, and completes a frame by the number lost before it. Blocks: no. Allocates: no.
    Grab tell(Grab grab) noexcept {
        switch (grab.outcome) {
            case Outcome::frame:
                grab.lost = grab.sequence - last_ - 1;
                last_ = grab.sequence;
                lost_.add(static_cast<std::int64_t>(grab.lost));
                delivered_.add();
                return grab;
            case Outcome::timeout: timeouts_.add(); break;
            case Outcome::damaged: damaged_.add(); break;
            case Outcome::other_shape: other_shape_.add(); break;
            case Outcome::end_of_stream:
            case Outcome::disconnected: break;
        }
        return {.outcome = grab.outcome};
    }

    FrameAccount account() const noexcept {
        return {.delivered = delivered_.value(),
                .lost = lost_.value(),
                .damaged = damaged_.value(),
                .other_shape = other_shape_.value(),
                .timeouts = timeouts_.value()};
    }

  private:
    std::uint64_t last_ = 0;
    Counter delivered_{};
    Counter lost_{};
    Counter damaged_{};
    Counter other_shape_{};
    Counter timeouts_{};
};

/// Why a source could not be opened.
enum class OpenError : std::uint8_t {
    not_found,     ///< there is no such camera or file, or no bus that one could be on
    not_readable,  ///< there is something, but it is no recording, or one that nobody here can decode
    busy,          ///< somebody else has it
    not_granted,   ///< permission is missing
    refused,       ///< the camera does not have the mode, rate or speed asked for
    other_shape,   ///< it gives frames of another size or format than asked for
    no_resources,  ///< bandwidth, buffers or memory are used up
    driver,        ///< the driver failed in a way that has no name above
};

constexpr const char* text(OpenError error) noexcept {
    switch (error) {
        case OpenError::not_found: return "not found";
        case OpenError::not_readable: return "not readable";
        case OpenError::busy: return "busy";
        case OpenError::not_granted: return "not granted";
        case OpenError::refused: return "refused";
        case OpenError::other_shape: return "another size or format";
        case OpenError::no_resources: return "no resources";
        case OpenError::driver: return "driver failure";
    }
    return "";
}

/// Why a source could not be opened, for programs and for people.
struct OpenFailure {
    OpenError error = OpenError::driver;
    std::string text{};  ///< what was asked for, what came instead, and what to do
};

/// A source, or why there is none.
template <class Source>
class [[nodiscard]] Opened {
  public:
    Opened(std::unique_ptr<Source> source) noexcept : source_{std::move(source)} {}
    Opened(OpenFailure failure) noexcept : failure_{std::move(failure)} {}

    explicit operator bool() const noexcept { return source_ != nullptr; }
    Source& operator*() const noexcept { return *operator->(); }
    Source* operator->() const noexcept {
        assert(source_ != nullptr && "nothing was opened");
        return source_.get();
    }
    /// Why there is no source. Empty if there is one.
    const OpenFailure& failure() const noexcept { return failure_; }

  private:
    std::unique_ptr<Source> source_{};
    OpenFailure failure_{};
};

/// A source of images. All but `account` is for one thread at a time, the one that grabs.
///
///     shape()               the shape of every frame
///     grab(into, watchdog)  fills the memory with a frame that was not delivered yet, waiting for it at most as long as
///                           the watchdog's budget lasts. The memory is of the source's shape, with whatever stride
///     account()             what became of the frames so far; for every thread
///
/// A source copies only from the driver's memory to the caller's. It does not allocate in `grab`, unless its adapter
/// says where its library does. Its destructor closes it.
template <class S>
concept FrameSource = requires(S& source, const S& idle, FrameView into, Watchdog& watchdog) {
    { idle.shape() } noexcept -> std::same_as<FrameShape>;
    { source.grab(into, watchdog) } noexcept -> std::same_as<Grab>;
    { idle.account() } noexcept -> std::same_as<FrameAccount>;
};

}  // namespace groundstate
