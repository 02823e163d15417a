#!/bin/sh
# Builds the tests of the C++ runtime and of the cameras as they are, under ThreadSanitizer, and under AddressSanitizer
# with UndefinedBehaviorSanitizer, and runs them. Usage: cpp/run.sh [PRESET...]. What is missing is installed.
set -eu
cd "$(dirname "$0")"

sh install.sh cmake ninja-build libgtest-dev \
    libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev \
    libdc1394-dev visp-images-data

for preset in ${*:-plain thread address}; do
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset" -- --quiet
    ctest --preset "$preset"
done
