// Without assertions a second access at once on one side of a buffer is refused and counted: no array is handed over, or taken
// back, that the first one still uses. Exits with the number of what did not hold.
#undef NDEBUG
#define NDEBUG

#include <utility>

#include "groundstate/locked_buffer.hpp"
#include "groundstate/virtual_clock.hpp"
#include "groundstate/wait_free_buffer.hpp"

using namespace groundstate;

template <class Buffer>
int refuses() {
    std::remove_reference_t<decltype(std::declval<Buffer&>().clock())> clock;
    Buffer buffer{clock};
    Watchdog watchdog{1'000};
    {
        auto first = buffer.write(watchdog);
        auto second = buffer.write(watchdog);
        if (!first || second) return 1;
        *first = 10;
        if (!first.publish() || buffer.account().dropped != 1) return 2;
    }
    {
        const auto first = buffer.read(watchdog);
        const auto second = buffer.read(watchdog);
        if (!first || second || second.attempted() || *first != 10 || buffer.account().missed != 1) return 3;
    }
    auto next = buffer.write(watchdog);
    if (!next) return 4;
    *next = 11;
    next.publish();
    const auto last = buffer.read(watchdog);
    return last && *last == 11 && last.fresh() ? 0 : 5;
}

int main() {
    int failed = 0;
    for (const int number : {refuses<WaitFreeBuffer<int, 3, VirtualClock>>(), refuses<WaitFreeBuffer<int, 5, VirtualClock>>(),
                             refuses<LockedBuffer<int, 2, Master::writer, VirtualClock>>(),
                             refuses<LockedBuffer<int, 2, Master::reader, VirtualClock>>(),
                             refuses<LockedBuffer<int, 2, Master::reader, MonotonicClock>>()}) {
        failed = failed * 10 + number;
    }
    return failed;
}
