#!/bin/sh
# Builds the C++ runtime's tests as they are, under ThreadSanitizer, and under AddressSanitizer with
# UndefinedBehaviorSanitizer, and runs them. Usage: cpp/run.sh [PRESET...]. What is missing it installs, and says so.
set -eu
cd "$(dirname "$0")"

missing=
command -v cmake >/dev/null || missing="$missing cmake"
command -v ninja >/dev/null || missing="$missing ninja-build"
if command -v apt-get >/dev/null; then
    [ -e /usr/include/gtest/gtest.h ] || missing="$missing libgtest-dev"
    if [ -n "$missing" ]; then
        echo "installing$missing"
        $([ "$(id -u)" = 0 ] || echo sudo) apt-get install -y --no-install-recommends $missing
    fi
elif [ -n "$missing" ]; then
    echo "cpp/run.sh: cmake 3.21 or later, ninja and GoogleTest are needed; missing:$missing" >&2
    exit 2
fi

for preset in ${*:-plain thread address}; do
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset" -- --quiet
    ctest --preset "$preset"
done
