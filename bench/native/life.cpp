// Conway's Game of Life on a torus of 32 x 32 cells: the twin of ../models/Life.asm.
#include <cstring>

#include "driver.hpp"

struct Life {
    char alive[32][32], next[32][32];
    volatile long generation = 0;

    Life() {
        for (int x = 0; x < 32; ++x)
            for (int y = 0; y < 32; ++y) alive[x][y] = (x * 7 + y * 13 + x * y * 3) % 5 < 2;
    }

    void step() {
        for (int x = 0; x < 32; ++x)
            for (int y = 0; y < 32; ++y) {
                const int left = (x + 31) & 31, right = (x + 1) & 31, up = (y + 31) & 31, down = (y + 1) & 31;
                const int n = alive[left][up] + alive[x][up] + alive[right][up] + alive[left][y] + alive[right][y] +
                              alive[left][down] + alive[x][down] + alive[right][down];
                next[x][y] = n == 3 || (n == 2 && alive[x][y]);
            }
        std::memcpy(alive, next, sizeof alive);
        generation = generation + 1;
    }

    void print() const {
        for (int x = 0; x < 32; ++x)
            for (int y = 0; y < 32; ++y) std::printf("alive(%d,%d)=%s\n", x, y, alive[x][y] ? "true" : "false");
        std::printf("generation=%ld\n", generation);
    }
};

int main(int argc, char** argv) { return run<Life>(argc, argv); }
