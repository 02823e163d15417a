#!/bin/sh
# The main job, end to end, on the paper's own case study: from the model to a robot's program that is held to it. Called by
# `make demo`. What the program takes beside g++ is installed (Debian packages). The tool and the program are compiled at the
# same time: the program's generated code lies in the repository, and step 3 shows that it is what the chart gives.
set -eu
groundstate=${GROUNDSTATE:-target/debug/groundstate}
compile=${COMPILE:-cargo build --locked --package cli}
study=examples/visual_servoing
log=out/robot/build.log
begin=$(date +%s)

# A heading, bold where it is looked at.
say() { if [ -t 1 ]; then printf '\n\033[1m%s\033[0m\n' "$1"; else printf '\n%s\n' "$1"; fi; }
fail() {
    echo "docs/demo.sh: $*" >&2
    exit 1
}

# The robot's program and what it takes, as `make robot` builds it. Behind the tool, for which all else waits.
build_robot() {
    sh cpp/install.sh cmake ninja-build libgtest-dev libeigen3-dev liborocos-kdl-dev libcli11-dev \
        libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev &&
        cmake -S examples -B target/cpp/robot -G Ninja -DGROUNDSTATE_WITHOUT_VISP=ON &&
        exec nice ninja -C target/cpp/robot visual_servoing
}

say "From a ground model to a robot that is held to it. First the tool and the robot's program are compiled, which takes some
minutes; then the controller runs as a model, as a program in virtual time, and in real time, and two pages show what it did."

say "0  Compile the tool; beside it, install what the robot's program takes and compile that ($log)"
rm -rf out/robot
mkdir -p out/robot/virtual out/robot/real
build_robot >"$log" 2>&1 &
builder=$!
trap 'kill $builder 2>/dev/null || true' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
$compile

say "1  Check the pattern library and the applications"
"$groundstate" check library/patterns examples

say "2  Run the complete controller for one simulated second (10 000 ticks of 0.1 ms), test every scenario, draw the report"
mkdir -p out
"$groundstate" report $study/CompleteController.asm --steps 10000 --scenarios library/patterns --scenarios examples -o out/report.html

say "3  Generate the controller's tasks from its chart: they are those that the robot's program was compiled with"
cp -R $study/robot out/robot/program
"$groundstate" generate cpp $study/ControllerSystem.chart -o out/robot/program
# Lines that say where the machines' texts are, seen from the folder, and the map of them, are others in another folder.
diff -r -x include -x '*.json' -I '^#line ' out/robot/program/generated $study/robot/generated ||
    fail "$study/robot/generated is not what the chart gives; generate it anew"
# What is left of its compiling, a line every few seconds.
waited=0
while kill -0 $builder 2>/dev/null; do
    sleep 1
    waited=$((waited + 1))
    [ $((waited % 5)) != 0 ] || tail -n 1 "$log" | cut -c 1-100
done
wait $builder || {
    cat "$log"
    fail "the robot's program cannot be compiled"
}
trap - EXIT
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
