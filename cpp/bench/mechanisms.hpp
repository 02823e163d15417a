// Ways to hand the latest datum from one thread to another, made comparable.
//
// Each has `write(fill, timer)` and `read(look, timer)`; the timer runs while the mechanism works and rests while the
// caller fills or looks at the datum. What works in place is timed without the filling; what copies is timed with its
// copies, for they are what it costs. `read` says whether there was anything to look at.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <mutex>

#ifdef GROUNDSTATE_BENCH_BOOST
#include <boost/lockfree/spsc_queue.hpp>
#endif

#include "groundstate/runtime.hpp"

#ifdef GROUNDSTATE_BENCH_ICEORYX2
// Of bench/iceoryx2.
extern "C" {
void* bench_iceoryx2_open(std::uint32_t number, std::size_t words);
std::uint64_t* bench_iceoryx2_loan(void* channel);
void bench_iceoryx2_send(void* channel);
const std::uint64_t* bench_iceoryx2_take(void* channel);
}
#endif

namespace bench {

using namespace groundstate;

// How long something took, less what the two looks at the clock take.
class Timer {
  public:
    explicit Timer(std::int64_t overhead_ns = 0) : overhead_ns_{overhead_ns} {}
    void go() { start_ns_ = clock_.now_ns(); }
    void rest() { spent_ns_ += std::max<std::int64_t>(0, clock_.now_ns() - start_ns_ - overhead_ns_); }
    std::int64_t spent_ns() const { return spent_ns_; }

  private:
    MonotonicClock clock_{};
    std::int64_t overhead_ns_;
    std::int64_t start_ns_ = 0;
    std::int64_t spent_ns_ = 0;
};

struct NoTimer {
    void go() {}
    void rest() {}
};

// Hands nothing over: what the measuring itself shows at such moments.
template <class T>
class Nothing {
  public:
    void prepare() { datum_.fill(0); }

    template <class Fill, class Watch>
    void write(Fill fill, Watch& timer) {
        timer.go();
        timer.rest();
        fill(datum_);
        timer.go();
        timer.rest();
    }

    template <class Look, class Watch>
    bool read(Look, Watch& timer) {
        timer.go();
        timer.rest();
        timer.go();
        timer.rest();
        return true;
    }

  private:
    T datum_;
};

// Both forms of the swinging buffer: in place. `publish` looks at the clock; with `Stamp::given` it need not.
enum class Stamp { taken, given };

template <class Buffer, Stamp stamp = Stamp::taken>
class Swinging {
  public:
    void prepare() {
        buffer_.prepare([](auto& datum) { datum.fill(0); });
    }

    template <class Fill, class Watch>
    void write(Fill fill, Watch& timer) {
        producer_.restart();
        timer.go();
        if (auto writing = buffer_.write(producer_)) {
            timer.rest();
            fill(*writing);
            timer.go();
            if constexpr (stamp == Stamp::taken) {
                writing.publish();
            } else {
                writing.publish_at(0);
            }
        }
        timer.rest();
    }

    template <class Look, class Watch>
    bool read(Look look, Watch& timer) {
        consumer_.restart();
        timer.go();
        bool looked = false;
        {
            const auto reading = buffer_.read(consumer_);
            timer.rest();
            looked = bool{reading};
            if (looked) {
                look(*reading);
            }
            timer.go();
        }
        timer.rest();
        return looked;
    }

  private:
    MonotonicClock clock_{};
    Buffer buffer_{clock_};
    Watchdog producer_{5'000'000};
    Watchdog consumer_{5'000'000};
};

// One datum behind a mutex, copied in and out.
template <class T>
class MutexAndCopy {
  public:
    void prepare() { staged_.fill(0), shared_.fill(0), taken_.fill(0); }

    template <class Fill, class Watch>
    void write(Fill fill, Watch& timer) {
        fill(staged_);
        timer.go();
        {
            const std::lock_guard guard{mutex_};
            shared_ = staged_;
            written_ = true;
        }
        timer.rest();
    }

    template <class Look, class Watch>
    bool read(Look look, Watch& timer) {
        timer.go();
        bool looked = false;
        {
            const std::lock_guard guard{mutex_};
            looked = written_;
            taken_ = shared_;
        }
        timer.rest();
        if (looked) {
            look(taken_);
        }
        return looked;
    }

  private:
    std::mutex mutex_{};
    T staged_, shared_, taken_;
    bool written_ = false;
};

// A sequence lock: the reader copies, and copies again if the writer was at work meanwhile. The words are atomic, as a
// copy of plain ones would be a race.
template <class T>
class SequenceLock {
  public:
    void prepare() { staged_.fill(0), taken_.fill(0); }

    template <class Fill, class Watch>
    void write(Fill fill, Watch& timer) {
        fill(staged_);
        timer.go();
        const std::uint64_t sequence = sequence_.load(std::memory_order_relaxed);
        sequence_.store(sequence + 1, std::memory_order_relaxed);
        // SYNC(seqlock): the odd number is seen before any of the words; the even one after all of them.
        std::atomic_thread_fence(std::memory_order_release);
        for (std::size_t i = 0; i < staged_.size(); ++i) {
            words_[i].store(staged_[i], std::memory_order_relaxed);
        }
        sequence_.store(sequence + 2, std::memory_order_release);
        timer.rest();
    }

    template <class Look, class Watch>
    bool read(Look look, Watch& timer) {
        timer.go();
        std::uint64_t before = 0;
        std::uint64_t after = 0;
        do {
            // SYNC(seqlock): the same number, even, before and after the words: nobody wrote meanwhile.
            before = sequence_.load(std::memory_order_acquire);
            for (std::size_t i = 0; i < taken_.size(); ++i) {
                taken_[i] = words_[i].load(std::memory_order_relaxed);
            }
            std::atomic_thread_fence(std::memory_order_acquire);
            after = sequence_.load(std::memory_order_relaxed);
        } while (before != after || before % 2 != 0);
        timer.rest();
        if (before != 0) {
            look(taken_);
        }
        return before != 0;
    }

  private:
    std::atomic<std::uint64_t> sequence_{0};
    std::array<std::atomic<std::uint64_t>, std::tuple_size_v<T>> words_{};
    T staged_, taken_;
};

#ifdef GROUNDSTATE_BENCH_BOOST
// A queue of Boost between one sender and one receiver, of which each cycle takes one datum.
template <class T>
class BoostQueue {
  public:
    void prepare() { staged_.fill(0), taken_.fill(0); }

    template <class Fill, class Watch>
    void write(Fill fill, Watch& timer) {
        fill(staged_);
        timer.go();
        queue_->push(staged_);
        timer.rest();
    }

    template <class Look, class Watch>
    bool read(Look look, Watch& timer) {
        timer.go();
        const bool looked = queue_->pop(taken_);
        timer.rest();
        if (looked) {
            look(taken_);
        }
        return looked;
    }

  private:
    using Queue = boost::lockfree::spsc_queue<T, boost::lockfree::capacity<8>>;
    std::unique_ptr<Queue> queue_ = std::make_unique<Queue>();
    T staged_, taken_;
};
#endif

#ifdef GROUNDSTATE_BENCH_ICEORYX2
// iceoryx2, made for processes: a publisher and a subscriber in shared memory, in place, the latest datum alone.
template <class T>
class Iceoryx2 {
  public:
    void prepare() {
        static std::uint32_t number = 0;
        channel_ = bench_iceoryx2_open(number++, std::tuple_size_v<T>);
        if (channel_ == nullptr) {
            std::abort();
        }
    }

    template <class Fill, class Watch>
    void write(Fill fill, Watch& timer) {
        timer.go();
        std::uint64_t* const words = bench_iceoryx2_loan(channel_);
        timer.rest();
        if (words == nullptr) {
            std::abort();
        }
        fill(*reinterpret_cast<T*>(words));
        timer.go();
        bench_iceoryx2_send(channel_);
        timer.rest();
    }

    template <class Look, class Watch>
    bool read(Look look, Watch& timer) {
        timer.go();
        const std::uint64_t* const words = bench_iceoryx2_take(channel_);
        timer.rest();
        if (words != nullptr) {
            look(*reinterpret_cast<const T*>(words));
        }
        return words != nullptr;
    }

  private:
    void* channel_ = nullptr;
};
#endif

}  // namespace bench
