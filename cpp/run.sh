#!/bin/sh
# Builds the tests of the C++ runtime and of the cameras as they are, under ThreadSanitizer, and under AddressSanitizer
# with UndefinedBehaviorSanitizer, and runs them; those of the runtime by clang++ as well. Usage: cpp/run.sh [PRESET...]. What is
# missing is installed. Where there is ccache, it is used.
set -eu
cd "$(dirname "$0")"

sh install.sh cmake ninja-build clang libgtest-dev \
    libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev \
    libdc1394-dev visp-images-data

command -v ccache >/dev/null && export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_SLOPPINESS=pch_defines,time_macros
for preset in ${*:-plain thread address clang}; do
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset" -- --quiet
    ctest --preset "$preset"
done
