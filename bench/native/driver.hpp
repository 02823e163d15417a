// What the native programs share: the random numbers that choose, and the frame of a measurement.
//
// A program is called with the number of steps; it makes them, prints `# seconds S` and then its final state, one
// `location=value` a line in the words of its AsmetaL twin, so that the two can be compared. A step reads the old state
// and writes the new one; what it computes is never left out, because the final state is printed.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

// xorshift64, the same as in xtask/src/bench/twins.rs, so that both make the same choices.
struct Random {
    std::uint64_t state = 0x2545F4914F6CDD1DULL;

    // A number below n, n > 0.
    std::uint32_t below(std::uint32_t n) {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        return static_cast<std::uint32_t>(((state >> 32) * n) >> 32);
    }
};

// Makes the steps given on the command line and prints the time they took.
template <typename Program>
int run(int argc, char** argv, Program& program) {
    const long steps = argc > 1 ? std::atol(argv[1]) : 1000;
    const auto start = std::chrono::steady_clock::now();
    for (long step = 0; step < steps; ++step) program.step();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    std::printf("# seconds %.9f\n", spent.count());
    program.print();
    return 0;
}
