// Five philosophers, one chosen a step: the twin of ../models/Philosophers.asm.
#include "driver.hpp"

// One update of a location, as it stands in an update set.
struct Update {
    int* location;
    int value;
};

struct Philosophers {
    static constexpr int nobody = -1;
    int owner[5], eating[5] = {}, hungry[5];
    int meals = 0;
    Random random;

    Philosophers() {
        for (int i = 0; i < 5; ++i) owner[i] = nobody, hungry[i] = 1;
    }

    void step() {
        const int p = static_cast<int>(random.below(5)), right = (p + 1) % 5;
        Update updates[8];
        int count = 0;
        if (eating[p]) {
            updates[count++] = {&owner[p], nobody};
            updates[count++] = {&owner[right], nobody};
            updates[count++] = {&eating[p], 0};
            updates[count++] = {&hungry[p], 0};
        } else if (hungry[p]) {
            if (owner[p] == nobody && owner[right] == nobody) {
                updates[count++] = {&owner[p], p};
                updates[count++] = {&owner[right], p};
                updates[count++] = {&eating[p], 1};
                updates[count++] = {&meals, meals + 1};
            }
        } else {
            updates[count++] = {&hungry[p], 1};
        }
        for (int i = 0; i < count; ++i) *updates[i].location = updates[i].value;
    }

    void print() const {
        for (int i = 0; i < 5; ++i) {
            if (owner[i] == nobody)
                std::printf("owner(%d)=undef\n", i);
            else
                std::printf("owner(%d)=%d\n", i, owner[i]);
            std::printf("eating(%d)=%s\nhungry(%d)=%s\n", i, eating[i] ? "true" : "false", i, hungry[i] ? "true" : "false");
        }
        std::printf("meals=%d\n", meals);
    }
};

int main(int argc, char** argv) {
    Philosophers program;
    return run(argc, argv, program);
}
