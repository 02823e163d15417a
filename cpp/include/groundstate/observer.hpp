// The observer of what happens in a channel, as template policy: `Unobserved` costs nothing, not even a branch.
//
// A channel calls its observer before an action of its protocol becomes visible to the other side (asks, releases,
// sends, stores), and after one that took something over (enters, takes, loads). So if one event of a task depends on
// one of another, their times are in the order in which they happened. The calls come from the thread of the acting
// side; none may throw. The observer of a generated system (observation.hpp) records them, and lets them take their
// time where a run in virtual time follows the ticks of the model.
#pragma once

#include <cstddef>
#include <cstdint>

namespace groundstate {

/// The two ends of a channel.
enum class Side : std::uint8_t { producer, consumer };

/// Faults of a channel that tests put in, to check that they are found (tests/ and `groundstate conform`).
enum class Fault : std::uint8_t { none, lock_not_taken, index_not_swapped, stale_read, watchdog_ignored };

/// Sees nothing.
struct Unobserved {
    void asks(Side) noexcept {}                                               // wants the lock
    void enters(Side) noexcept {}                                             // has the lock
    void gives_up(Side) noexcept {}                                           // the watchdog ended first
    void releases(Side) noexcept {}                                           // is about to release the lock
    void swaps(std::size_t, std::size_t, std::uint64_t) noexcept {}           // indexes read and written, the datum's number
    void managed() noexcept {}                                                // the master's index section is over
    void writes(std::size_t, std::uint64_t) noexcept {}                       // array and number of a writing that begins
    static constexpr bool offers() noexcept { return false; }                 // whether a slave's writing is awaited from its beginning
    void reads(std::size_t, std::uint64_t, bool) noexcept {}                  // array, number, whether it is new
    void looks() noexcept {}                                                  // is about to look for room in a queue
    void sends(std::uint64_t) noexcept {}                                     // is about to append the message of that number
    void refuses() noexcept {}                                                // the queue stayed full
    void takes(std::uint64_t) noexcept {}                                     // took the message of that number; 0: none
    void stores(std::uint64_t) noexcept {}                                    // is about to publish, wait-free
    void loads(std::uint64_t, bool) noexcept {}                               // took the latest, wait-free; 0: none
    static constexpr bool seeded(Fault) noexcept { return false; }
};

}  // namespace groundstate
