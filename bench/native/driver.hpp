// What the native programs share: the random numbers that choose, an update, and the frame of a measurement.
//
// A program is called with the number of steps and how often it is to make them, each time from its initial state. It
// prints `# seconds S`, all of them together without the making of initial states, and then the final state, one
// `location=value` a line in the words of its AsmetaL twin, so that the two can be compared. A step reads the old state
// and writes the new one; what it computes is never left out, because the final state is printed.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

// xorshift64, the same as in xtask/src/bench/twins.rs, so that both make the same choices. SYNC(random)
struct Random {
    std::uint64_t state = 88172645463325252ULL;

    // A number below n, n > 0.
    std::uint32_t below(std::uint32_t n) {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        return static_cast<std::uint32_t>(((state >> 32) * n) >> 32);
    }
};

// One update of a location, as it stands in an update set.
struct Update {
    int* location;
    int value;
};

// Makes the steps given on the command line and prints the time they took.
// Flattened, so that the step is part of the loop as it would be in a program written out; a LARGE one is left to the
// compiler.
template <typename Program>
#if !defined(LARGE)
[[gnu::flatten]]
#endif
int run(int argc, char** argv) {
    const long steps = argc > 1 ? std::atol(argv[1]) : 1000;
    const long rounds = argc > 2 ? std::atol(argv[2]) : 1;
    std::chrono::duration<double> spent{};
    auto program = std::make_unique<Program>();
    for (long round = 0; round < rounds; ++round) {
        program = std::make_unique<Program>();
        const auto start = std::chrono::steady_clock::now();
        for (long step = 0; step < steps; ++step) program->step();
        spent += std::chrono::steady_clock::now() - start;
    }
    std::printf("# seconds %.9f\n", spent.count());
    program->print();
    return 0;
}
