#!/bin/sh
# What it costs to hand data over, beside other mechanisms, and to draw a simulated frame. Usage: cpp/bench/run.sh, from
# anywhere. iceoryx2 is built by cargo where it can be had; boost is measured where its headers are.
set -eu
cd "$(dirname "$0")"
iceoryx2=
if (cd iceoryx2 && CARGO_TARGET_DIR=../../../target/iceoryx2 cargo build --quiet --release --locked); then
    iceoryx2=$(realpath ../../target/iceoryx2/release/libbench_iceoryx2.a)
fi
sh ../run.sh plain
build=../../target/cpp/plain
cmake -DGROUNDSTATE_BENCH_ICEORYX2="$iceoryx2" "$build" >/dev/null
cmake --build "$build" --target hand_over -- --quiet
"$build/bench/hand_over"
"$build/adapters/simulated/tests/simulated_frame"
