// Five philosophers, one chosen a step: the twin of ../models/Philosophers.asm.
#include "driver.hpp"

struct Philosophers {
    static constexpr int nobody = -1;
    int owner[5], eating[5] = {}, hungry[5];
    int meals = 0;
    volatile long steps = 0;
    Random random;

    Philosophers() {
        for (int i = 0; i < 5; ++i) owner[i] = nobody, hungry[i] = 1;
    }

    void step() {
        const int p = static_cast<int>(random.below(5)), right = (p + 1) % 5;
        Update updates[16];
        int count = 0;
        if (hungry[p] && !eating[p] && owner[p] == nobody && owner[right] == nobody) {
            updates[count++] = {&owner[p], p};
            updates[count++] = {&owner[right], p};
            updates[count++] = {&eating[p], 1};
            updates[count++] = {&meals, meals + 1};
        }
        if (eating[p]) {
            updates[count++] = {&owner[p], nobody};
            updates[count++] = {&owner[right], nobody};
            updates[count++] = {&eating[p], 0};
            updates[count++] = {&hungry[p], 0};
        }
        if (!hungry[p] && !eating[p]) updates[count++] = {&hungry[p], 1};
        for (int i = 0; i < count; ++i) *updates[i].location = updates[i].value;
        steps = steps + 1;
    }

    void print() const {
        for (int i = 0; i < 5; ++i) {
            if (owner[i] == nobody)
                std::printf("owner(%d)=undef\n", i);
            else
                std::printf("owner(%d)=%d\n", i, owner[i]);
            std::printf("eating(%d)=%s\nhungry(%d)=%s\n", i, eating[i] ? "true" : "false", i, hungry[i] ? "true" : "false");
        }
        std::printf("meals=%d\nsteps=%ld\n", meals, steps);
    }
};

int main(int argc, char** argv) { return run<Philosophers>(argc, argv); }
