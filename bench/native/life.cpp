// Conway's Game of Life on a torus of 32 x 32 cells: the twin of ../models/Life.asm.
#include <cstring>

#include "driver.hpp"

struct Life {
    static constexpr int side = 32;
    char alive[side][side], next[side][side];
    long generation = 0;

    Life() {
        for (int x = 0; x < side; ++x)
            for (int y = 0; y < side; ++y) alive[x][y] = (x * 7 + y * 13 + x * y * 3) % 5 < 2;
    }

    void step() {
        for (int x = 0; x < side; ++x)
            for (int y = 0; y < side; ++y) {
                const int left = (x + side - 1) % side, right = (x + 1) % side;
                const int up = (y + side - 1) % side, down = (y + 1) % side;
                const int n = alive[left][up] + alive[x][up] + alive[right][up] + alive[left][y] + alive[right][y] +
                              alive[left][down] + alive[x][down] + alive[right][down];
                next[x][y] = n == 3 || (n == 2 && alive[x][y]);
            }
        std::memcpy(alive, next, sizeof alive);
        ++generation;
    }

    void print() const {
        for (int x = 0; x < side; ++x)
            for (int y = 0; y < side; ++y) std::printf("alive(%d,%d)=%s\n", x, y, alive[x][y] ? "true" : "false");
        std::printf("generation=%ld\n", generation);
    }
};

int main(int argc, char** argv) {
    Life program;
    return run(argc, argv, program);
}
