// visual_servoing: the controller and the simulated cell for so long; what happened as JSON, what was seen as PNG.
// Exit status: 0 it converged, or came to rest as it must when the camera is gone; 1 it did not; 2 usage, or the world;
// 3 it did so, but data were not valid or the log is not whole.
#include <cstdio>

#include <groundstate/closed_loop/command_line.hpp>

#include "pictures.hpp"
#include "run_file.hpp"

using namespace controller_system;
using groundstate::closed_loop::CommandLine;
using groundstate::closed_loop::Json;

int main(int count, char** words) {
    LoopSettings settings;
    std::string views;
    CommandLine line{"visual_servoing", "An arm guided by the camera in its hand, in closed loop", settings.run};
    line.disturbances(settings.disturbances);
    int fault = 0;
    line.choice("--hook", fault, {"works", "throws", "hangs", "waits", "nan"}, "what that of visual servoing does after 1 s");
    line.folder("--views", views, "write some images of the camera there, with the features and their way");
    if (const auto status = line.read(count, words)) {
        return *status;
    }
    settings.hook_fault = static_cast<HookFault>(fault);
    const Loop loop = run(settings);
    tell(loop.account);
    std::printf("camera: %lld images, %lld lost; searched whole %ld times\n", static_cast<long long>(loop.frames.delivered),
                static_cast<long long>(loop.frames.lost), loop.servoing->searches());
    std::printf("%s\n", ending(loop).c_str());
    if (!views.empty()) {
        const std::size_t pictures = write_pictures(views, loop);
        std::printf("%zu views in %s\n", pictures, views.c_str());
        if (pictures == 0) {
            line.complain("no view could be written to " + views);
            return 2;
        }
    }
    return line.end(loop.account, loop.as_expected(settings),
                    [&](Json& json) { write_columns(json, settings, loop, line.from_run_file(views)); });
}
