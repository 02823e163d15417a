#!/bin/sh
# Builds the applications' programs and what robots need beside the runtime, and tests them. Usage:
# examples/robot.sh GROUNDSTATE, the tool, which holds what the programs did to their models.
# What is missing is installed; ViSP is there for a test alone, as the judge of the servo law.
set -eu
groundstate=$(realpath "$1")
cd "$(dirname "$0")"

sh ../cpp/install.sh cmake ninja-build libgtest-dev libeigen3-dev liborocos-kdl-dev libcli11-dev \
    libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev \
    libvisp-vs-dev visp-images-data

build=../target/cpp/robot
cmake -S . -B "$build" -G Ninja >/dev/null
cmake --build "$build" -- --quiet
ctest --test-dir "$build" --output-on-failure
sh programs.sh "$build"
sh held.sh "$build" "$groundstate"
sh sanitized.sh thread micro_assembly
sh sanitized.sh address visual_servoing
sh seeded.sh "$build-address" "$groundstate"
