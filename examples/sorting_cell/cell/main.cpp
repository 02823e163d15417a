// The sorting cell in closed loop with a simulated belt.
#include "camera.hpp"
#include "classifier.hpp"
#include "encoder.hpp"
#include "leftPusher.hpp"
#include "reader.hpp"
#include "rightPusher.hpp"
#include "sequencer.hpp"

int main(int count, char** words) {
    using namespace sorting_cell;
    Belt belt;
    CameraHooks camera{belt};
    ReaderHooks reader;
    ClassifierHooks classifier;
    EncoderHooks encoder{belt};
    SequencerHooks sequencer{belt};
    LeftPusherHooks left_pusher{belt};
    RightPusherHooks right_pusher{belt};
    return groundstate::run_program<System>(
        count, words,
        Hooks{.camera = camera, .reader = reader, .classifier = classifier, .encoder = encoder, .sequencer = sequencer,
              .leftPusher = left_pusher, .rightPusher = right_pusher});
}
