// The sieve of Eratosthenes beside 10 000 counters that all move on in every step: the twin of ../models/Sieve.asm.
#include <vector>

#include "driver.hpp"

struct Sieve {
    std::vector<int> x, next;
    std::vector<char> composite, marked;
    long p = 2;

    Sieve() : x(10000), next(10000), composite(10001), marked(10001) {
        for (int i = 0; i < 10000; ++i) x[i] = i;
    }

    void step() {
        for (int i = 0; i < 10000; ++i) next[i] = (x[i] * 75 + 74) % 65537;
        if (p <= 10000 && !composite[p]) {
            for (int k = 2; k <= 5000; ++k)
                if (p * k <= 10000) marked[p * k] = 1;
            composite = marked;
        }
        x.swap(next);
        ++p;
    }

    void print() const {
        for (int i = 0; i < 10000; ++i) std::printf("x(%d)=%d\n", i, x[i]);
        for (int n = 0; n <= 10000; ++n) std::printf("composite(%d)=%s\n", n, composite[n] ? "true" : "false");
        std::printf("p=%ld\n", p);
    }
};

int main(int argc, char** argv) { return run<Sieve>(argc, argv); }
