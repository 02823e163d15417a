#!/bin/sh
# Builds the fuzz targets with coverage instrumentation and runs each for a while. Usage: fuzz/run.sh [SECONDS]
# Works on stable Rust: libFuzzer comes with the crate libfuzzer-sys, the instrumentation is LLVM's own.
set -eu
cd "$(dirname "$0")/.."
seconds=${1:-20}
host=$(rustc -vV | sed -n 's/^host: //p')
out=out/fuzz

RUSTFLAGS="--cfg fuzzing -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
-Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
-Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=4" \
    cargo build --quiet --release --locked --manifest-path fuzz/Cargo.toml --target "$host" --target-dir target/fuzz

# Seeds: this project's own models and scenarios.
mkdir -p "$out/seeds"
find library examples -name '*.asm' -o -name '*.avalla' | while read -r file; do
    cp "$file" "$out/seeds/$(echo "$file" | tr / _)"
done

for source in fuzz/targets/*.rs; do
    target=$(basename "$source" .rs)
    mkdir -p "$out/$target/corpus"
    echo "fuzz: $target, $seconds s"
    if ! "target/fuzz/$host/release/$target" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=4096 -max_len=16384 \
        -artifact_prefix="$out/$target/" -print_final_stats=1 "$out/$target/corpus" "$out/seeds" >"$out/$target/log" 2>&1
    then
        tail -n 40 "$out/$target/log"
        echo "fuzz: $target failed; run it again with target/fuzz/$host/release/$target FILE"
        exit 1
    fi
    grep -E 'stat::number_of_executed_units|stat::peak_rss_mb' "$out/$target/log" | sed 's/^stat::/  /'
done
