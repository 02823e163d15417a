// All that threads share, at full speed: under ThreadSanitizer each access is checked for a race, and in every build
// each datum for being whole and newer than the one before.
//
//     stress         runs all of it; 1 if something is wrong
//     stress torn    the negative control: data copied without the lock, which ThreadSanitizer must report
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "groundstate/runtime.hpp"

using namespace groundstate;

namespace {

using Words = std::array<std::uint64_t, 64>;
constexpr std::uint64_t rounds = 20'000;
constexpr std::int64_t second_ns = 1'000'000'000;

std::atomic<bool> good{true};

void expect(bool holds, const char* what) {
    if (!holds && good.exchange(false)) {
        std::fprintf(stderr, "stress: %s\n", what);
    }
}

template <class F, class G>
void at_once(F first, G second) {
    std::thread left{first};
    std::thread right{second};
    left.join();
    right.join();
}

bool whole(const Words& words) {
    return std::all_of(words.begin(), words.end(), [&](std::uint64_t word) { return word == words[0]; });
}

// The producer writes its rounds; the consumer reads until it has seen the last one.
template <class Buffer>
void hand_over(const char* what) {
    MonotonicClock clock;
    const auto buffer = std::make_unique<Buffer>(clock);
    Signal signal{clock};
    buffer->wakes(signal);
    at_once(
        [&] {
            Watchdog watchdog{60 * second_ns};
            for (std::uint64_t round = 1; round <= rounds; ++round) {
                watchdog.restart();
                auto writing = buffer->write(watchdog);
                expect(bool{writing}, what);
                writing->fill(round);
                writing.publish();
                if (round % 16 == 0) {
                    std::this_thread::yield();
                }
            }
        },
        [&] {
            Watchdog watchdog{60 * second_ns};
            for (std::uint64_t last = 0; last < rounds;) {
                watchdog.restart();
                const std::uint32_t seen = signal.count();
                if (!buffer->available()) {
                    signal.wait_while(seen, never_ns);
                    continue;
                }
                const auto reading = buffer->read(watchdog);
                if (!reading) {
                    continue;
                }
                expect(whole(*reading), what);
                expect(reading.sequence() == (*reading)[0], what);
                expect(reading.fresh() == (reading.sequence() > last) && reading.sequence() >= last, what);
                last = reading.sequence();
            }
        });
    const Account account = buffer->account();
    expect(account.written == static_cast<std::int64_t>(rounds) && account.pending() == 0, what);
    expect(account.handed_over == account.read + account.unread, what);
    std::printf("%-32s read %6ld, unread %6ld, overwritten %6ld\n", what, long{account.read}, long{account.unread},
                long{account.overwritten});
}

void messages() {
    MonotonicClock clock;
    MessageQueue<std::uint64_t, 8, MonotonicClock> queue{clock};
    Signal signal{clock};
    queue.wakes(signal);
    at_once(
        [&] {
            Watchdog watchdog{60 * second_ns};
            for (std::uint64_t message = 0; message < rounds; ++message) {
                watchdog.restart();
                expect(queue.send(message, watchdog), "a message was refused");
            }
        },
        [&] {
            for (std::uint64_t next = 0; next < rounds;) {
                const std::uint32_t seen = signal.count();
                if (const auto message = queue.receive()) {
                    expect(*message == next++, "messages out of order");
                } else {
                    signal.wait_while(seen, never_ns);
                }
            }
        });
    std::printf("%-32s %ld in order\n", "message queue", static_cast<long>(queue.taken()));
}

// Four users and one permit: a plain number behind it. Short budgets, so that many give up in the moment of the grant.
void permits() {
    MonotonicClock clock;
    Semaphore semaphore{clock};
    long inside = 0;
    std::array<long, 4> done{};
    std::array<long, 4> skipped{};
    const auto user = [&](int number) {
        const auto at = static_cast<std::size_t>(number);
        Watchdog watchdog{2'000 + 20'000 * number};
        for (std::uint64_t round = 0; round < rounds; ++round) {
            watchdog.restart();
            if (semaphore.acquire(number, watchdog)) {
                ++inside;
                ++done[at];
                if (round % 64 == 0) {
                    std::this_thread::yield();
                }
                semaphore.release();
            }
        }
        skipped[at] = watchdog.skipped();
    };
    at_once([&] { at_once([&] { user(0); }, [&] { user(1); }); }, [&] { at_once([&] { user(2); }, [&] { user(3); }); });
    const long sum = done[0] + done[1] + done[2] + done[3];
    const long skips = skipped[0] + skipped[1] + skipped[2] + skipped[3];
    expect(inside == sum, "two users inside at once");
    expect(sum + skips == 4 * static_cast<long>(rounds), "a skip was not counted");
    expect(semaphore.permits() == 1 && semaphore.illegal_releases() == 0, "a permit was lost or made");
    std::printf("%-32s inside %ld, given up %ld\n", "semaphore", sum, skips);
}

// What the swinging buffer is for: the same copy, with nothing to keep writer and reader apart.
void torn() {
    Words shared{};
    Words source{};
    Words copy{};
    at_once(
        [&] {
            for (std::uint64_t round = 1; round <= rounds; ++round) {
                source.fill(round);
                std::memcpy(shared.data(), source.data(), sizeof shared);
            }
        },
        [&] {
            for (std::uint64_t round = 1; round <= rounds; ++round) {
                std::memcpy(copy.data(), shared.data(), sizeof shared);
            }
        });
    std::printf("torn copy: last word %lu\n", static_cast<unsigned long>(copy[63]));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], "torn") == 0) {
        torn();
        return EXIT_SUCCESS;
    }
    hand_over<WaitFreeBuffer<Words, 3, MonotonicClock>>("wait-free, 3 arrays");
    hand_over<WaitFreeBuffer<Words, 5, MonotonicClock>>("wait-free, 5 arrays");
    hand_over<LockedBuffer<Words, 2, Master::writer, MonotonicClock>>("locked, 2 arrays, master writes");
    hand_over<LockedBuffer<Words, 2, Master::reader, MonotonicClock>>("locked, 2 arrays, master reads");
    hand_over<LockedBuffer<Words, 4, Master::reader, MonotonicClock>>("locked, 4 arrays, master reads");
    messages();
    permits();
    return good.load() ? EXIT_SUCCESS : EXIT_FAILURE;
}
