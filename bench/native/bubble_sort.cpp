// Bubble sort by single swaps of neighbours chosen at random: the twin of ../models/BubbleSort.asm.
#include "driver.hpp"

struct BubbleSort {
    static constexpr int most = 4096;
    // Known only when it runs, as the model's array is.
    volatile int given = 64;
    int size = given;
    int a[most];
    int swaps = 0;
    Random random;

    BubbleSort() { turn_round(); }

    void turn_round() {
        for (int i = 0; i < size; ++i) a[i] = size - 1 - i;
        swaps = 0;
    }

    void step() {
        // A sorted array is turned round between two steps.
        if (swaps == size * (size - 1) / 2) turn_round();
        int candidates[most], count = 0;
        for (int i = 0; i < size - 1; ++i)
            if (a[i] > a[i + 1]) candidates[count++] = i;
        const int i = candidates[random.below(static_cast<std::uint32_t>(count))];
        const int left = a[i + 1], right = a[i];
        a[i] = left;
        a[i + 1] = right;
        ++swaps;
    }

    void print() const {
        for (int i = 0; i < size; ++i) std::printf("a(%d)=%d\n", i, a[i]);
        std::printf("swaps=%d\n", swaps);
    }
};

int main(int argc, char** argv) { return run<BubbleSort>(argc, argv); }
