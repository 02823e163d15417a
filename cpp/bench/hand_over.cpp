// What it costs to hand the latest datum over, and how old it then is: two threads, each mechanism in turn.
//
//     hand_over [SECONDS]     so long for each line of the tables; 3 unless given
//
// Frames of 307 200 bytes every 10 ms, read every 12 ms; samples of 64 bytes every 0.5 ms, read every 1 ms. Figures are
// printed and judged by people; a torn datum alone makes the program fail.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "mechanisms.hpp"

using namespace bench;

namespace {

constexpr std::int64_t us = 1'000;

using Frame = std::array<std::uint64_t, 307'200 / sizeof(std::uint64_t)>;
using Sample = std::array<std::uint64_t, 64 / sizeof(std::uint64_t)>;

// Figures of one side; room is made before the start.
class Figures {
  public:
    void reserve(std::size_t count) { figures_.reserve(count); }
    void add(std::int64_t figure) {
        if (figures_.size() < figures_.capacity()) {
            figures_.push_back(figure);
        }
    }
    // Of a hundred, so many are not above it.
    double at(std::size_t percent) {
        if (figures_.empty()) {
            return 0;
        }
        std::sort(figures_.begin(), figures_.end());
        return static_cast<double>(figures_[std::min(figures_.size() - 1, figures_.size() * percent / 100)]);
    }

  private:
    std::vector<std::int64_t> figures_{};
};

// When each datum had been handed over, known to the reader.
class Journal {
  public:
    void handed_over(std::uint64_t number, std::int64_t at_ns) {
        at_ns_[number % size].store(at_ns, std::memory_order_relaxed);
        last_.store(number, std::memory_order_release);  // SYNC(journal): after the time of this number
    }
    std::uint64_t last() const { return last_.load(std::memory_order_acquire); }  // SYNC(journal)

    // For how long there had been something newer than this datum when a reading began.
    std::int64_t stale_ns(std::uint64_t number, std::uint64_t last, std::int64_t begun_ns) const {
        return number < last ? begun_ns - at_ns_[(number + 1) % size].load(std::memory_order_relaxed) : 0;
    }

  private:
    static constexpr std::size_t size = 1 << 16;
    std::array<std::atomic<std::int64_t>, size> at_ns_{};
    std::atomic<std::uint64_t> last_{0};
};

std::int64_t timer_overhead_ns() {
    std::vector<std::int64_t> looks;
    for (int i = 0; i < 10'001; ++i) {
        Timer timer;
        timer.go();
        timer.rest();
        looks.push_back(timer.spent_ns());
    }
    std::nth_element(looks.begin(), looks.begin() + 5'000, looks.end());
    return looks[5'000];
}

struct Rates {
    std::int64_t write_ns;
    std::int64_t read_ns;
};

long torn_in_all = 0;

template <class Mechanism, class T>
void measure(const char* name, Rates rates, std::int64_t overhead_ns, double seconds) {
    MonotonicClock clock;
    const auto mechanism = std::make_unique<Mechanism>();
    mechanism->prepare();
    const auto journal = std::make_unique<Journal>();
    const auto duration_ns = static_cast<std::int64_t>(seconds * 1e9);
    Figures writing;
    Figures reading;
    Figures stale;
    writing.reserve(static_cast<std::size_t>(duration_ns / rates.write_ns + 1));
    reading.reserve(static_cast<std::size_t>(duration_ns / rates.read_ns + 1));
    stale.reserve(static_cast<std::size_t>(duration_ns / rates.read_ns + 1));
    long torn = 0;

    // Each has a processor of its own where there are two.
    const Schedule here{.realtime = {.priority = 50, .processor = 0}};
    const Schedule there{.realtime = {.priority = 50, .processor = 1}};
    PeriodicTask writer{clock, "writer", {.period_ns = rates.write_ns, .late = Late::skip},
                        [&](const Cycle& cycle) {
                            const auto number = static_cast<std::uint64_t>(cycle.number) + 1;
                            Timer timer{overhead_ns};
                            mechanism->write([&](T& datum) { datum.fill(number); }, timer);
                            journal->handed_over(number, clock.now_ns());
                            writing.add(timer.spent_ns());
                        },
                        here};
    PeriodicTask reader{clock, "reader", {.period_ns = rates.read_ns, .late = Late::skip},
                        [&](const Cycle&) {
                            const std::uint64_t last = journal->last();
                            const std::int64_t begun_ns = clock.now_ns();
                            Timer timer{overhead_ns};
                            std::uint64_t number = 0;
                            const auto look = [&](const T& datum) {
                                number = datum[0];
                                torn += std::count(datum.begin(), datum.end(), number) != std::ssize(datum);
                            };
                            if (mechanism->read(look, timer)) {
                                reading.add(timer.spent_ns());
                            }
                            if (number != 0) {
                                stale.add(journal->stale_ns(number, last, begun_ns));
                            }
                        },
                        there};
    const std::int64_t origin_ns = clock.now_ns();
    writer.start(origin_ns);
    reader.start(origin_ns + rates.read_ns / 3);
    clock.sleep_until_ns(origin_ns + duration_ns);
    reader.stop();
    writer.stop();
    const bool fifo = writer.thread().granted().priority == Grant::granted;
    std::printf("%-28s %8.0f %8.0f %8.0f   %8.0f %8.0f %8.0f   %8.1f %8.1f   %4ld%s\n", name, writing.at(50),
                writing.at(99), writing.at(100), reading.at(50), reading.at(99), reading.at(100),
                stale.at(50) / 1e3, stale.at(100) / 1e3, torn, fifo ? "" : "  (not SCHED_FIFO)");
    std::fflush(stdout);
    torn_in_all += torn;
}

template <class T>
void table(const char* title, Rates rates, std::int64_t overhead_ns, double seconds) {
    std::printf("\n%s\n%-28s %26s   %26s   %17s\n", title, "", "write, ns", "read, ns", "stale, us");
    std::printf("%-28s %8s %8s %8s   %8s %8s %8s   %8s %8s   %4s\n",  //
                "", "p50", "p99", "max", "p50", "p99", "max", "p50", "max", "torn");
    using C = MonotonicClock;
    measure<Nothing<T>, T>("nothing at all", rates, overhead_ns, seconds);
    measure<Swinging<WaitFreeBuffer<T, 3, C>>, T>("wait-free buffer", rates, overhead_ns, seconds);
    measure<Swinging<WaitFreeBuffer<T, 3, C>, Stamp::given>, T>("wait-free, stamp given", rates, overhead_ns, seconds);
    measure<Swinging<LockedBuffer<T, 2, Master::writer, C>>, T>("locked buffer, master writes", rates, overhead_ns,
                                                                seconds);
    measure<Swinging<LockedBuffer<T, 2, Master::reader, C>>, T>("locked buffer, master reads", rates, overhead_ns,
                                                                seconds);
    measure<MutexAndCopy<T>, T>("mutex and copy", rates, overhead_ns, seconds);
    measure<SequenceLock<T>, T>("sequence lock", rates, overhead_ns, seconds);
#ifdef GROUNDSTATE_BENCH_BOOST
    measure<BoostQueue<T>, T>("boost::lockfree::spsc_queue", rates, overhead_ns, seconds);
#endif
#ifdef GROUNDSTATE_BENCH_ICEORYX2
    measure<Iceoryx2<T>, T>("iceoryx2", rates, overhead_ns, seconds);
#endif
}

// What this thread has worked, whatever else the machine does.
std::int64_t worked_ns() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

// The same without another thread and without rest: the instructions alone, all in the nearest cache.
template <class Mechanism, class T>
void measure_alone(const char* name) {
    constexpr int rounds = 200'000;
    const auto mechanism = std::make_unique<Mechanism>();
    mechanism->prepare();
    std::array<std::int64_t, 9> means{};
    for (std::int64_t& mean : means) {
        const std::int64_t start_ns = worked_ns();
        for (int i = 0; i < rounds; ++i) {
            NoTimer timer;
            mechanism->write([&](T& datum) { datum[0] = static_cast<std::uint64_t>(i); }, timer);
            mechanism->read([](const T&) {}, timer);
        }
        mean = (worked_ns() - start_ns) * 10 / rounds;
    }
    std::nth_element(means.begin(), means.begin() + 4, means.end());
    std::printf("%-28s %8.1f\n", name, static_cast<double>(means[4]) / 10);
}

template <class T>
void table_alone(const char* title) {
    using C = MonotonicClock;
    std::printf("\n%s\n", title);
    measure_alone<Swinging<WaitFreeBuffer<T, 3, C>>, T>("wait-free buffer");
    measure_alone<Swinging<WaitFreeBuffer<T, 3, C>, Stamp::given>, T>("wait-free, stamp given");
    measure_alone<Swinging<LockedBuffer<T, 2, Master::writer, C>>, T>("locked buffer, master writes");
    measure_alone<Swinging<LockedBuffer<T, 2, Master::reader, C>>, T>("locked buffer, master reads");
    measure_alone<MutexAndCopy<T>, T>("mutex and copy");
    measure_alone<SequenceLock<T>, T>("sequence lock");
#ifdef GROUNDSTATE_BENCH_BOOST
    measure_alone<BoostQueue<T>, T>("boost::lockfree::spsc_queue");
#endif
#ifdef GROUNDSTATE_BENCH_ICEORYX2
    measure_alone<Iceoryx2<T>, T>("iceoryx2");
#endif
}

}  // namespace

int main(int argc, char** argv) {
    const double seconds = argc > 1 ? std::atof(argv[1]) : 3;
    const std::int64_t overhead_ns = timer_overhead_ns();
    std::printf("Hand-over between two threads; a look at the clock takes %ld ns and is taken off.\n",
                long{overhead_ns});
    table<Frame>("Frames of 307200 bytes, written every 10 ms, read every 12 ms", {10'000 * us, 12'000 * us},
                 overhead_ns, seconds);
    table<Sample>("Samples of 64 bytes, written every 0.5 ms, read every 1 ms", {500 * us, 1'000 * us}, overhead_ns,
                  seconds);
    table_alone<Sample>("Samples of 64 bytes, written and read in turn by one thread, ns of its time for both");
    return torn_in_all == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
