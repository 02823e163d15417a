#!/bin/sh
# Builds applications' programs and what robots need beside the runtime, and tests them. Usage:
# examples/robot.sh GROUNDSTATE [PROGRAM…]; GROUNDSTATE is the tool, which holds what the programs did to their models.
# Without a program named it is all four, and everything: under the sanitizers, with faults put in, the servo law beside ViSP's.
# What is missing is installed; ViSP is there for a test alone, as the judge of the servo law.
set -eu
groundstate=$(realpath "$1")
shift
cd "$(dirname "$0")"

needed="cmake ninja-build libgtest-dev libeigen3-dev liborocos-kdl-dev libcli11-dev visp-images-data
    libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev"
build=../target/cpp/robot
# shellcheck disable=SC2086 # several words
if [ $# -gt 0 ]; then
    sh generated.sh "$groundstate" "$@"
    sh ../cpp/install.sh $needed
    cmake -S . -B "$build" -G Ninja -DGROUNDSTATE_WITHOUT_VISP=ON >/dev/null
    targets="robotics_tests robotics_allocation_test recorded_dots"
    tests=robotics
    for program in "$@"; do
        targets="$targets $program ${program}_tests"
        tests="$tests|$program"
    done
    cmake --build "$build" --target $targets -- --quiet
    ctest --test-dir "$build" --output-on-failure --tests-regex "^($tests)"
    sh programs.sh "$build" "$@"
    sh held.sh "$build" "$groundstate" "$@"
    exit
fi

# shellcheck disable=SC2086
sh ../cpp/install.sh $needed libvisp-vs-dev
set -- visual_servoing object_tracking pick_and_place micro_assembly
sh generated.sh "$groundstate" "$@"
cmake -S . -B "$build" -G Ninja -DGROUNDSTATE_WITHOUT_VISP=OFF >/dev/null
cmake --build "$build" -- --quiet
ctest --test-dir "$build" --output-on-failure
sh programs.sh "$build" "$@"
sh held.sh "$build" "$groundstate" "$@"
sh sanitized.sh thread "$@"
sh sanitized.sh address "$@"
sh seeded.sh "$build-address" "$groundstate"
