// A FireWire camera of the stand-in, as the conformance suite wants it.
#pragma once

#include "../../conformance/frame_source_suite.hpp"

#include <groundstate/dc1394/camera.hpp>

#include "standin/standin.hpp"

namespace groundstate::dc1394 {

template <PixelFormat Format>
struct Rig {
    using Source = Camera;
    static constexpr bool allocates = false;

    Opened<Source> open(const conformance::Script& the_script) {
        script = the_script;
        frame = 0;
        standin::begin();
        auto camera = Source::open({.shape = {640, 480, Format}});
        if (!script.late) {
            pass();
        }
        return camera;
    }

    // One frame that can be fetched, with some before it that cannot; after the last one the cable is pulled.
    void pass() {
        for (bool fetched = false; !fetched;) {
            if (frame == script.frames) {
                standin::unplug();
                return;
            }
            ++frame;
            const bool lost = script.loses && frame % 5 < 2;
            standin::take({.lost = lost,
                           .corrupt = script.damages && frame % 5 == 3,
                           .short_data = script.damages && frame % 5 == 4});
            fetched = !lost;
        }
    }

    conformance::Script script{};
    std::uint64_t frame = 0;
};

using Rigs = testing::Types<Rig<PixelFormat::mono8>, Rig<PixelFormat::rgb8>, Rig<PixelFormat::bgr8>>;

}  // namespace groundstate::dc1394
