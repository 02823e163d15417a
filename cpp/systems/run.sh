#!/bin/sh
# Generates programs from systems, compiles them, and holds what they do to their models; puts in faults, which must be
# found; lets hooks, the log and the scheduling fail. Usage: cpp/systems/run.sh GROUNDSTATE, from anywhere.
set -eu
groundstate=$(realpath "$1")
cd "$(dirname "$0")"
sh ../install.sh clang cmake
out=../../target/systems
rm -rf "$out"
mkdir -p "$out"

fail() {
    echo "cpp/systems/run.sh: $*" >&2
    exit 1
}

# expect CODES COMMAND…: runs it, and wants one of those exit codes. Its output goes to $out/said.
expect() {
    wanted=$1
    shift
    code=0
    timeout 120 "$@" >"$out/said" 2>&1 || code=$?
    case " $wanted " in *" $code "*) return ;; esac
    { cat "$out/said"; fail "exit code $code instead of $wanted: $*"; }
}

said() {
    grep -q -- "$1" "$out/said" || { cat "$out/said"; fail "not said: $1"; }
}

# compile FOLDER FLAGS…
compile() { compile_by g++ "$@"; }

# compile_by COMPILER FOLDER FLAGS…
compile_by() {
    compiler=$1
    folder=$2
    shift 2
    "$compiler" -std=c++20 -Wall -Wextra -Wconversion -Wpedantic -Wshadow -Werror "$@" \
        -I "$folder" -I "$folder/generated/include" "$folder/main.cpp" -o "$folder/program" -pthread
}

# The complete controller, with hooks that do nothing: every event in the tick in which the model has it. What its machines decide is
# replayed beside that.
model=../../examples/visual_servoing/ControllerSystem
expect 0 "$groundstate" generate cpp $model.chart -o "$out/controller"
compile "$out/controller" -O0 "$out"/controller/generated/machines/*.cpp
expect 0 "$out/controller/program" --virtual 0.5 --log "$out/controller.mcap"
expect 0 "$groundstate" conform $model.asm "$out/controller.mcap"
said "conforms tick by tick: 27"
said "^[1-9][0-9]* decisions are those of the components' machines"
expect 0 "$groundstate" conform --untimed $model.asm "$out/controller.mcap"
expect 0 "$groundstate" conform --follow $model.asm "$out/controller.mcap"
said "conforms tick by tick: 27"
expect 0 sh viewers/run.sh "$out/controller.mcap"
compile_by clang++ "$out/controller" -Wsign-conversion -fsyntax-only

# Tasks that data wake, behind writings of several ticks: the program wakes when the model does.
for form in "Classifier" "Handover" "Conveyor" "Conveyor --wait-free" "Fusion" "Fusion --wait-free"; do
    name=${form% *}
    folder=$out/$(echo "$form" | tr -d ' ')
    expect 0 "$groundstate" generate cpp ${form#"$name"} $name.chart -o "$folder"
    compile "$folder" -O0
    expect 0 "$folder/program" --virtual 0.5 --log "$folder/run.mcap"
    expect 0 "$groundstate" conform $name.asm "$folder/run.mcap"
    said "conforms tick by tick"
    expect 0 "$folder/program" --virtual 0.5 --seed 1 --log "$folder/run.mcap"
    expect 0 "$groundstate" conform $name.asm "$folder/run.mcap"
    expect "0 3" "$folder/program" --real 0.2 --log "$folder/run.mcap"
    expect "0 3" "$groundstate" conform $name.asm "$folder/run.mcap"
done
# A task that starts when one of its data has come, though its model needs all, is found, and so is the other way round: by what its
# recording says of it, and, where that is the model's, by when its cycles begin.
for swap in all/any any/all; do
    folder=$out/swapped
    rm -rf "$folder"
    mkdir "$folder"
    sed -e "s|import ../../|import $(realpath ../..)/|" -e "s/awaits ${swap%/*} /awaits ${swap#*/} /" Fusion.chart >"$folder/Fusion.chart"
    expect 0 "$groundstate" generate cpp "$folder/Fusion.chart" -o "$folder"
    compile "$folder" -O0
    expect 0 "$folder/program" --virtual 0.5 --log "$folder/run.mcap"
    expect 2 "$groundstate" conform Fusion.asm "$folder/run.mcap"
    said "the recording is of another system: .* awaits ${swap#*/} "
    sed -i "s/\.awaits = \"[a-z]* \(frames\)/.awaits = \"all \1/; s/\.awaits = \"[a-z]* \(fixes\)/.awaits = \"any \1/" "$folder/generated/fusion.hpp"
    compile "$folder" -O0
    expect 0 "$folder/program" --virtual 0.5 --log "$folder/run.mcap"
    expect 1 "$groundstate" conform Fusion.asm "$folder/run.mcap"
    case $swap in
        # Cycles that begin too late are no difference in the order of events.
        all/any) expect 1 "$groundstate" conform --untimed Fusion.asm "$folder/run.mcap" && said "still waits for data" ;;
    esac
done
# What a chart bounds: the program counts what its model counts. It tells so at its end, in its log, in the report and beside the verdict.
watched=$out/watched
expect 0 "$groundstate" generate cpp Watched.chart -o "$watched"
compile "$watched" -O0
expect 0 "$watched/program" --virtual 2 --log "$watched/run.mcap"
cp "$out/said" "$watched/told"
expect 0 "$groundstate" conform Watched.asm "$watched/run.mcap"
said "conforms tick by tick"
! grep -q "outside the chart's bounds" "$out/said" || fail "something is outside in modelled time"
# counted WHAT OUTSIDE MOST: in a file of what was told.
counted() { grep -q "^$1  .*  [1-9][0-9]*  *$2  *$3\$" "$told" || { cat "$told"; fail "not counted: $*"; }; }
# in_model RUN LOCATION TICKS: what the model has counted after as many steps.
echo 'always: {endsNow(camera): false, endsNow(vision): false, isReleased(camera): true, isReleased(motor): true}' >"$watched/longest.yaml"
printf ':run 4000\n:state way_oldest\n:state reading_longest\n' >"$watched/asked"
"$groundstate" run Watched.asm --input "$watched/longest.yaml" -i --show none <"$watched/asked" >"$watched/model" 2>&1
in_model() { grep -q "  $1 = $2\$" "$watched/model" || { cat "$watched/model"; fail "not in the model: $*"; }; }
told=$watched/told
in_model "way_oldest(bound1_way1)" 94
counted "age from camera to arm" 0 "47000.0 us"
in_model "way_oldest(bound2_way1)" 15
counted "age from control to motor" 0 "7500.0 us"
in_model "reading_longest(control_read_marks_fresh)" 32
counted "new marks for control" 0 "16000.0 us"
in_model "reading_longest(motor_read_set_fresh)" 8
counted "new set for motor" 0 "4000.0 us"
counted "look of camera" 0 "5000.0 us"
counted "releases of camera" 0 "0.0 us"
counted "deadlines missed by control" 0 0
expect 0 "$groundstate" report Watched.asm --run "$watched/run.mcap" -o "$watched/report.html"
grep -q "age from camera to arm" "$watched/report.html" || fail "the report does not show what is bounded"
# What the program took becomes the distribution of a run of the model: here all is the longest, in time.
expect 0 "$groundstate" report Watched.asm --run "$watched/run.mcap" --write-inputs "$watched/times.yaml"
said "^endsNow(camera): 200 elaborations\$"
[ "$(grep -c 'after' "$watched/times.yaml")" = 4 ] || fail "not four distributions"
grep -qx '  endsNow(vision): after 16:133' "$watched/times.yaml" || { cat "$watched/times.yaml"; fail "lengths are not counted"; }
"$groundstate" run Watched.asm --input "$watched/times.yaml" -i --show none <"$watched/asked" >"$watched/model" 2>&1
in_model "way_oldest(bound1_way1)" 94
in_model "reading_longest(control_read_marks_fresh)" 32
# Tighter bounds, and deadlines that no cycle meets: all that is outside is counted.
sed -e "s|import ../../|import $(realpath ../..)/|" -e 's/within 60 ms/within 46.5 ms/' -e 's/every 28 ms/every 15.5 ms/' -e 's/deadline 3.5 ms/deadline 2 ms/' \
    Watched.chart >"$watched/Watched.chart"
expect 0 "$groundstate" generate cpp "$watched/Watched.chart" -o "$watched"
compile "$watched" -O0
expect 0 "$watched/program" --virtual 2 --log "$watched/run.mcap"
cp "$out/said" "$watched/told"
counted "age from camera to arm" "[1-9][0-9]*" "47000.0 us"
counted "new marks for control" "[1-9][0-9]*" "16000.0 us"
counted "deadlines missed by control" 499 5
expect 0 "$groundstate" chart build "$watched/Watched.chart"
expect 0 "$groundstate" conform "$watched/Watched.asm" "$watched/run.mcap"
said "^499 of 500 were outside the chart's bounds, as the program counted: deadlines missed by control (1 of 5)"
# Hooks that do nothing are done far too soon.
expect "0 3" "$watched/program" --real 0.2
cp "$out/said" "$watched/told"
grep -q "^look of camera  *3..5 ms  *\([1-9][0-9]*\)  *\1  " "$told" || { cat "$told"; fail "short elaborations are not counted"; }

# Two arrays, where the system above has three; and one tick, where it has several.
short=$out/short
mkdir "$short"
sed -e 's/swinging buffer 3/swinging buffer 2/' -e 's/\(write .*\) 0\.[0-9] ms/\1 0.1 ms/' -e "s|import ../../|import $(realpath ../..)/|" \
    Classifier.chart >"$short/Classifier.chart"
expect 0 "$groundstate" chart build "$short/Classifier.chart"
expect 0 "$groundstate" generate cpp "$short/Classifier.chart" -o "$short"
compile "$short" -O0
expect 0 "$short/program" --virtual 0.5 --log "$short/run.mcap"
expect 0 "$groundstate" conform "$short/Classifier.asm" "$short/run.mcap"
said "conforms tick by tick"

# Channels with several readers: each gets what was decided, in both forms of the buffer; one that does not is found.
for form in "" --wait-free; do
    dock=$out/dock$form
    mkdir -p "$dock"
    cp dock/camera.hpp "$dock"
    sed "s|import ../../../|import $(realpath ../..)/|" dock/Dock.chart >"$dock/Dock.chart"
    cp dock/*.asm "$dock"
    expect 0 "$groundstate" chart build "$dock/Dock.chart"
    expect 0 "$groundstate" generate cpp $form "$dock/Dock.chart" -o "$dock"
    compile_dock() { compile "$dock" -O0 "$dock"/generated/machines/*.cpp; }
    compile_dock
    for run in "--virtual 1" "--virtual 1 --seed 3"; do
        expect 0 "$dock/program" $run --log "$dock/run.mcap"
        expect 0 "$groundstate" conform "$dock/Dock.asm" "$dock/run.mcap"
        said "^280 decisions are those"
    done
    expect "0 3" "$dock/program" --real 0.2 --log "$dock/run.mcap"
    expect "0 3" "$groundstate" conform "$dock/Dock.asm" "$dock/run.mcap"
    cp "$dock/generated/dock.hpp" "$dock/made.hpp"
    copy='aim_logger_channel_.own() = aim_motor_channel_.own();'
    grep -q "$copy" "$dock/made.hpp" || fail "the second reader's datum is not brought"
    for fault in "" "$copy aim_logger_channel_.own().value += 1;"; do
        sed "s/$copy/$fault/" "$dock/made.hpp" >"$dock/generated/dock.hpp"
        compile_dock
        expect 0 "$dock/program" --virtual 1 --log "$dock/run.mcap"
        expect 1 "$groundstate" conform "$dock/Dock.asm" "$dock/run.mcap"
        said "logger got aim_logger = .*, which was decided as"
    done
done

# Files of the user's stay as they are.
mkdir -p "$out/contention"
cp contention/data.hpp contention/main.cpp "$out/contention"
expect 0 "$groundstate" generate cpp Contention.chart -o "$out/contention"
said "your files, left as they are: main.cpp, data.hpp"
echo '// mine' >>"$out/contention/fast.hpp"
expect 0 "$groundstate" generate cpp Contention.chart -o "$out/contention"
tail -1 "$out/contention/fast.hpp" | grep -qx '// mine' || fail "a file of the user's was overwritten"
cmp contention/main.cpp "$out/contention/main.cpp"

program=$out/contention/program
log=$out/contention.mcap
conform="$groundstate conform Contention.asm $log"

# By another compiler.
compile_by clang++ "$out/contention" -O0
expect 0 env HOOK=none "$program" --virtual 0.3 --log "$log"
expect 0 $conform
said "conforms tick by tick"

# The program, and the class of its own model, in one project.
mkdir -p "$out/both"
expect 0 "$groundstate" generate cpp Contention.asm -o "$out/both/machine"
grep -q '"file": "../../../../cpp/systems/Contention.asm"' "$out/both/machine/source-map.json" || fail "no path from the output to the model"
! grep -q "$(cd ../.. && pwd)" "$out/both/machine/"*.* || fail "generated code names a folder of this machine"
cp -r "$out/both/machine" "$out/elsewhere"
model=$(realpath Contention.asm)
machine=$(realpath "$out/both/machine")
rm "$machine"/*.*
(cd / && "$groundstate" generate cpp "$model" -o "$machine" >"$machine/said")
grep -q '^renamed in C++: ' "$machine/said" && fail "names of the model differ in C++"
rm "$machine/said"
diff -r "$out/elsewhere" "$machine" || fail "the same model gives other code when made from another folder"
cp -r contention "$out/both/program"
expect 0 "$groundstate" generate cpp Contention.chart -o "$out/both/program"
cat >"$out/both/CMakeLists.txt" <<'EOF'
cmake_minimum_required(VERSION 3.21)
project(both LANGUAGES CXX)
add_subdirectory(machine)
add_subdirectory(program)
target_link_libraries(contention PRIVATE groundstate::contention_machine)
EOF
expect 0 cmake -S "$out/both" -B "$out/both/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS=-Werror
expect 0 cmake --build "$out/both/build" --target contention
expect 0 "$out/both/build/program/contention" --virtual 0.1

compile "$out/contention" -O1 -DGROUNDSTATE_SEEDED_FAULTS

expect 0 env HOOK=none "$program" --virtual 1 --log "$log"
expect 0 $conform
said "conforms tick by tick"
expect 0 "$program" --virtual 1 --log "$log"
expect 0 $conform
said "conforms by the order of events"
for seed in 1 2 3; do
    expect 0 "$program" --virtual 1 --seed $seed --log "$log"
    expect 0 $conform
    said "conforms by the order of events"
done
# On a busy machine events are lost, which the program says, and what is missing is not known.
expect "0 3" "$program" --real 0.5 --log "$log"
expect "0 3" $conform

# Faults of the runtime, each found: a lock not taken, indexes not swapped, a stale reading, a watchdog ignored.
for fault in 1 2 3 4; do
    expect 0 env HOOK=none "$program" --virtual 0.1 --seed-fault $fault --log "$log"
    expect 1 $conform
    said "parts tick by tick"
done
for fault in 1 2 3 4; do
    expect 0 "$program" --virtual 0.1 --seed 1 --seed-fault $fault --log "$log"
    expect 1 $conform
    said "parts by the order of events"
done
said "the model: gives_up position"

# Read along: a parting is told while the program goes on. Of one that was killed nobody knows the end.
following() {
    rm -f "$log"
    "$program" --real 300 "$@" --log "$log" >/dev/null &
    running=$!
    trap 'kill $running 2>/dev/null || true' EXIT
}
following --seed-fault 2
expect 1 $conform --follow
said "parts by the order of events"
kill $running 2>/dev/null || fail "the program had ended before the parting was told"
following
expect 3 timeout --preserve-status -s INT 3 $conform --follow
said "not known, by the order of events: the run went on"
kill $running
wait $running 2>/dev/null || true
trap - EXIT
expect 3 $conform
"$program" --real 0.5 --log "$log" >/dev/null &
expect "0 3" $conform --follow
wait

# Hooks that fail.
expect 1 env HOOK=throw "$program" --virtual 1 --log "$log"
said "task slow failed in cycle 20, phase slow_law: the law has no solution; the others were stopped safely"
[ "$(grep ^stopped: "$out/said" | tr '\n' ' ')" = "stopped: fast stopped: slow " ] || fail "not stopped in order, actuators first"
expect 1 env HOOK=hang "$program" --real 5 --log "$log"
said "task fast hung in cycle 20, phase fast_control: no progress for"
said "stopped: fast"
expect 1 env HOOK=hang "$program" --virtual 5 --patience 1 --log "$log"
said "task fast hung in cycle 20, phase fast_control: no progress for 1000 ms of the wall clock"
said "stopped: slow"
expect 3 env HOOK=nan "$program" --virtual 1 --log "$log"
said "^slow .* 1  *[0-9]*  *[0-9]*$"
said "task slow made 1 data that are not valid; they were not handed over"
expect 0 $conform

# A log that cannot be written: the robot goes on, and says so; what is missing is never taken for good.
expect 3 "$program" --virtual 0.1 --log /dev/full
said "the log ended early: No space left on device"
expect 3 sh -c 'trap "" XFSZ; ulimit -f 400; exec "$0" --virtual 1 --log "$1"' "$program" "$log"
said "the log ended early: File too large"
expect 3 $conform
said "not known, by the order of events"
[ "$(tail -c 8 "$log" | od -An -c | tr -d ' ')" = '211MCAP0\r\n' ] || fail "the log of a full disk has no end"
expect 0 "$program" --virtual 1 --log "$log"
head -c 600000 "$log" >"$out/cut.mcap"
expect 3 "$groundstate" conform Contention.asm "$out/cut.mcap"
said "not known, by the order of events: the recording has no end"
expect 2 "$program" --virtual 0.1 --log "$out/missing/run.mcap"

# No permission for real-time scheduling.
if [ "$(id -u)" = 0 ]; then
    # Where another user may run it.
    public=$(mktemp -d)
    chmod 755 "$public"
    cp "$program" "$public/program"
    expect 0 setpriv --reuid=65534 --regid=65534 --clear-groups prlimit --rtprio=0 \
        "$public/program" --real 0.2 --realtime 20
    rm -r "$public"
else
    expect 0 prlimit --rtprio=0 "$program" --real 0.2 --realtime 20
fi
said "no permission for real-time scheduling"

# Without a lock: the channels are held to the model as shared values.
expect 0 "$groundstate" generate cpp --wait-free Contention.chart -o "$out/contention"
compile "$out/contention" -O1 -g1 -fsanitize=thread -DGROUNDSTATE_SEEDED_FAULTS
expect 0 env HOOK=none "$program" --virtual 0.5 --log "$log"
expect 0 $conform
said "conforms tick by tick"
expect 0 "$program" --virtual 0.5 --seed 1 --log "$log"
expect 0 $conform
said "conforms by the order of events"
expect "0 3" "$program" --real 0.3 --log "$log"
expect "0 3" $conform
for fault in 2 3; do
    expect 0 env HOOK=none "$program" --virtual 0.1 --seed-fault $fault --log "$log"
    expect 1 $conform
    said "parts tick by tick"
    expect 0 "$program" --virtual 0.1 --seed 1 --seed-fault $fault --log "$log"
    expect 1 $conform
    said "parts by the order of events"
done

echo "systems: the generated programs conform, and every fault was found"
