// Bubble sort by single swaps of neighbours chosen at random: the twin of ../models/BubbleSort.asm.
#include "driver.hpp"

struct BubbleSort {
    static constexpr int size = 64;
    int a[size];
    long swaps = 0;
    Random random;

    BubbleSort() { turn_round(); }

    void turn_round() {
        for (int i = 0; i < size; ++i) a[i] = size - 1 - i;
    }

    void step() {
        int candidates[size], count = 0;
        for (int i = 0; i + 1 < size; ++i)
            if (a[i] > a[i + 1]) candidates[count++] = i;
        if (count == 0) {
            turn_round();
            return;
        }
        const int i = candidates[random.below(static_cast<std::uint32_t>(count))];
        const int left = a[i + 1], right = a[i];
        a[i] = left;
        a[i + 1] = right;
        ++swaps;
    }

    void print() const {
        for (int i = 0; i < size; ++i) std::printf("a(%d)=%d\n", i, a[i]);
        std::printf("swaps=%ld\n", swaps);
    }
};

int main(int argc, char** argv) {
    BubbleSort program;
    return run(argc, argv, program);
}
