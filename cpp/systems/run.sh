#!/bin/sh
# Generates programs from systems, compiles them, and holds what they do to their models; puts in faults, which must be
# found; lets hooks, the log and the scheduling fail. Usage: cpp/systems/run.sh GROUNDSTATE, from anywhere.
set -eu
groundstate=$(realpath "$1")
cd "$(dirname "$0")"
out=../../target/systems
rm -rf "$out"
mkdir -p "$out"

fail() {
    echo "cpp/systems/run.sh: $*" >&2
    exit 1
}

# expect CODE COMMAND…: runs it, and wants that exit code. Its output goes to $out/said.
expect() {
    wanted=$1
    shift
    code=0
    timeout 120 "$@" >"$out/said" 2>&1 || code=$?
    [ "$code" = "$wanted" ] || { cat "$out/said"; fail "exit code $code instead of $wanted: $*"; }
}

said() {
    grep -q -- "$1" "$out/said" || { cat "$out/said"; fail "not said: $1"; }
}

# compile FOLDER FLAGS…
compile() {
    folder=$1
    shift
    g++ -std=c++20 -Wall -Wextra -Wconversion -Wpedantic -Wshadow -Werror "$@" \
        -I "$folder" -I "$folder/generated/include" "$folder/main.cpp" -o "$folder/program" -pthread
}

# The complete controller, with hooks that do nothing: every event in the tick in which the model has it.
model=../../examples/visual_servoing/ControllerSystem
expect 0 "$groundstate" generate cpp $model.chart -o "$out/controller"
compile "$out/controller" -O0
expect 0 "$out/controller/program" --virtual 0.5 --log "$out/controller.mcap"
expect 0 "$groundstate" conform $model.asm "$out/controller.mcap"
said "conforms tick by tick: 27"
expect 0 "$groundstate" conform --untimed $model.asm "$out/controller.mcap"
expect 0 "$groundstate" conform --follow $model.asm "$out/controller.mcap"
said "conforms tick by tick: 27"
expect 0 sh viewers/run.sh "$out/controller.mcap"

# Files of the user's stay as they are.
mkdir -p "$out/contention"
cp contention/data.hpp contention/main.cpp "$out/contention"
expect 0 "$groundstate" generate cpp Contention.chart -o "$out/contention"
said "yours, left as they are: main.cpp, data.hpp"
echo '// mine' >>"$out/contention/fast.hpp"
expect 0 "$groundstate" generate cpp Contention.chart -o "$out/contention"
tail -1 "$out/contention/fast.hpp" | grep -qx '// mine' || fail "a file of the user's was overwritten"
cmp contention/main.cpp "$out/contention/main.cpp"

compile "$out/contention" -O1 -DGROUNDSTATE_SEEDED_FAULTS
program=$out/contention/program
log=$out/contention.mcap
conform="$groundstate conform Contention.asm $log"

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
expect 0 "$program" --real 0.5 --log "$log"
expect 0 $conform

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
expect 0 $conform --follow
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
expect 0 env HOOK=nan "$program" --virtual 1 --log "$log"
said "^slow .* 1  *[0-9]*  *[0-9]*$"
expect 0 $conform

# A log that cannot be written: the robot goes on, and says so; what is missing is never taken for good.
expect 0 "$program" --virtual 0.1 --log /dev/full
said "the log ended early: No space left on device"
expect 0 "$program" --virtual 1 --log "$log"
head -c 600000 "$log" >"$out/cut.mcap"
expect 3 "$groundstate" conform Contention.asm "$out/cut.mcap"
said "not known, by the order of events: the recording has a gap, or ends early"
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
expect 0 "$program" --real 0.3 --log "$log"
expect 0 $conform
for fault in 2 3; do
    expect 0 env HOOK=none "$program" --virtual 0.1 --seed-fault $fault --log "$log"
    expect 1 $conform
    said "parts tick by tick"
    expect 0 "$program" --virtual 0.1 --seed 1 --seed-fault $fault --log "$log"
    expect 1 $conform
    said "parts by the order of events"
done

echo "systems: the generated programs conform, and every fault was found"
