// A producer and a consumer over a swinging buffer: the twin of ../models/ProducerConsumer.asm.
#include "driver.hpp"

struct ProducerConsumer {
    enum Mode { busy, done };
    int buffer[2][8] = {};
    int producer = busy, consumer = done, front = 0, written = 0, taken = 0, item = 1, total = 0;
    volatile long steps = 0;

    void step() {
        Update updates[16];
        int count = 0;
        if (producer == busy) {
            updates[count++] = {&buffer[front][written], item};
            updates[count++] = {&item, (item * 5 + 3) % 1000};
            if (written == 7) {
                updates[count++] = {&producer, done};
                updates[count++] = {&written, 0};
            } else {
                updates[count++] = {&written, written + 1};
            }
        }
        if (consumer == busy) {
            updates[count++] = {&total, (total + buffer[1 - front][taken]) % 1000003};
            if (taken == 7) {
                updates[count++] = {&consumer, done};
                updates[count++] = {&taken, 0};
            } else {
                updates[count++] = {&taken, taken + 1};
            }
        }
        if (producer == done && consumer == done) {
            updates[count++] = {&front, 1 - front};
            updates[count++] = {&producer, busy};
            updates[count++] = {&consumer, busy};
        }
        for (int i = 0; i < count; ++i) *updates[i].location = updates[i].value;
        steps = steps + 1;
    }

    void print() const {
        for (int a = 0; a < 2; ++a)
            for (int s = 0; s < 8; ++s) std::printf("buffer(%d,%d)=%d\n", a, s, buffer[a][s]);
        std::printf("producer=%s\nconsumer=%s\n", producer == busy ? "BUSY" : "DONE", consumer == busy ? "BUSY" : "DONE");
        std::printf("front=%d\nwritten=%d\ntaken=%d\nitem=%d\ntotal=%d\nsteps=%ld\n", front, written, taken, item, total, steps);
    }
};

int main(int argc, char** argv) { return run<ProducerConsumer>(argc, argv); }
