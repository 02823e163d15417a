#!/bin/sh
# The main job, end to end, on the paper's own case study: from the model to a robot's program that is held to it. Called by
# `make demo`. What the program takes beside g++ is installed (Debian packages).
set -eu
groundstate=${GROUNDSTATE:-target/debug/groundstate}
cargo=${CARGO:-cargo}
study=examples/visual_servoing
begin=$(date +%s)

# A heading, bold where it is looked at.
say() { if [ -t 1 ]; then printf '\n\033[1m%s\033[0m\n' "$1"; else printf '\n%s\n' "$1"; fi; }
fail() {
    echo "docs/demo.sh: $*" >&2
    exit 1
}
# progress COMMAND…: its output shortened to a line every few seconds; all of it if it fails.
progress() {
    log=out/robot/build.log
    "$@" >"$log" 2>&1 &
    worker=$!
    waited=0
    while kill -0 $worker 2>/dev/null; do
        sleep 1
        waited=$((waited + 1))
        [ $((waited % 10)) != 0 ] || tail -n 1 "$log" | cut -c 1-100
    done
    wait $worker || { cat "$log"; return 1; }
}

say "From a ground model to a robot that is held to it. First the tool and the robot's program are compiled, which takes some
minutes; then the controller runs as a model, as a program in virtual time, and in real time, and two pages show what it did."

say "0  Compile the tool"
$cargo build --locked --package cli

say "1  Check the pattern library and the applications"
"$groundstate" check library/patterns examples

say "2  Run the complete controller for one simulated second (10 000 ticks of 0.1 ms), test every scenario, draw the report"
mkdir -p out
"$groundstate" report $study/CompleteController.asm --steps 10000 --scenarios library/patterns --scenarios examples -o out/report.html

say "3  Generate the controller's tasks from its chart, compile them with the robot"
sh cpp/install.sh cmake ninja-build libgtest-dev libeigen3-dev liborocos-kdl-dev libcli11-dev \
    libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev
rm -rf out/robot
mkdir -p out/robot/virtual out/robot/real
cp -R $study/robot out/robot/program
"$groundstate" generate cpp $study/ControllerSystem.chart -o out/robot/program
cmp out/robot/program/generated/controller_system.hpp $study/robot/generated/controller_system.hpp ||
    fail "$study/robot/generated is not what the chart gives; generate it anew"
# As `make robot` builds it.
compile() {
    cmake -S examples -B target/cpp/robot -G Ninja -DGROUNDSTATE_WITHOUT_VISP=ON &&
        cmake --build target/cpp/robot --target visual_servoing
}
progress compile || fail "the robot's program cannot be compiled"
robot=target/cpp/robot/visual_servoing/robot/visual_servoing
echo "$robot"

# record FOLDER OPTIONS…: a run of the robot, with all that it leaves.
record() {
    folder=out/robot/$1
    shift
    "$robot" "$@" --run "$folder/run.json" --log "$folder/run.mcap" --views "$folder"
}

say "4  Ten seconds of closed loop in virtual time: does it come where it has to?"
record virtual --virtual 10s

say "5  Five seconds in real time, for the statistics: they tell of this machine and of what else it does"
# 1: it does not come where it has to; 3: not all of the log could be written in time. Both are of this machine.
code=0
record real --real 5s || code=$?
case $code in 0 | 1 | 3) ;; *) fail "the robot's program ended with $code" ;; esac

say "6  Hold both runs to the model, event by event, and draw the robot's report"
code=0
"$groundstate" report $study/ControllerSystem.asm --run out/robot/virtual/run.json --run out/robot/real/run.json \
    -o out/robot.html || code=$?
# 3: the writer of the log did not keep up in real time. What happened in virtual time is known in any case.
[ $code = 0 ] || [ $code = 3 ] || fail "the robot did not do what its model says"

say "Open out/report.html (the model) and out/robot.html (the robot) in any browser; they need no network."
took=$(($(date +%s) - begin))
echo "All of it took $((took / 60)) min $((took % 60)) s."
