#!/bin/sh
# The main job, end to end, on the paper's own case study. Called by `make demo`.
set -eu
groundstate=${GROUNDSTATE:-target/release/groundstate}
model=examples/visual_servoing/CompleteController.asm

say() { printf '\n\033[1m%s\033[0m\n' "$1"; }

say "1  Check the pattern library and the applications"
"$groundstate" check library/patterns examples

say "2  Run the complete controller for one simulated second (10 000 ticks of 0.1 ms), test every scenario, draw the report"
mkdir -p out
"$groundstate" report "$model" --steps 10000 --scenarios library/patterns --scenarios examples -o out/report.html

say "Open out/report.html in any browser; it needs no network."
