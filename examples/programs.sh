#!/bin/sh
# Runs applications' programs and looks at what they say and at their exit codes: verdicts in virtual time, a moment of
# real time, wrong usage, files that cannot be written. Usage: examples/programs.sh BUILD PROGRAM…, from anywhere.
set -eu
build=$(realpath "$1")
shift
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

fail() {
    cat "$out/said"
    echo "examples/programs.sh: $*" >&2
    exit 1
}

# expect CODE PROGRAM ARGUMENT…: what it says goes to $out/said.
expect() {
    wanted=$1
    program=$2
    shift 2
    code=0
    timeout 300 "$build"/*/*/"$program" "$@" >"$out/said" 2>&1 || code=$?
    [ "$code" = "$wanted" ] || fail "exit code $code instead of $wanted: $program $*"
}

said() {
    grep -q -- "$1" "$out/said" || fail "not said: $1"
}

# Undisturbed, no deadline is missed and nothing is skipped: the columns of tasks with a deadline and of all tasks.
punctual() {
    awk 'NF == 8 && $2 ~ /^[0-9]+$/ { n++; if ($4 != 0 || $5 != 0) bad = 1 } END { exit bad || n == 0 }' "$out/said" ||
        fail "a deadline was missed, or something skipped"
}

# What --run wrote: a verdict among the results.
recorded() {
    python3 -c '
import json, sys
run = json.load(open(sys.argv[1]))
assert run["end"][sys.argv[2]] is True, run["end"]
assert len(run["tasks"]) >= 5 and all(task["cycles"] > 0 for task in run["tasks"]), run["tasks"]
' "$out/run.json" "$1" || fail "$program --run: not what was said"
}

# Verdicts, good and bad; what each does without images, and with hooks that fail: one that throws, one that never
# returns, in either time; one that gives what is not a number.
visual_servoing() {
    expect 0 visual_servoing --virtual 5s --run "$out/run.json" --log "$out/run.mcap"
    said "degrees from the last goal: converged"
    punctual
    recorded converged
    [ -s "$out/run.mcap" ] || fail "no log"
    # The same bytes each time; one of them is the log's name.
    cp "$out/run.json" "$out/first.json"
    expect 0 visual_servoing --virtual 5s --run "$out/run.json" --log "$out/run.mcap"
    cmp "$out/first.json" "$out/run.json" || fail "another run for the same seed"
    expect 1 visual_servoing --virtual 300ms
    said "not converged"
    expect 0 visual_servoing --virtual 2s --unplugged 500ms
    said "holding, without set-points"
    expect 1 visual_servoing --virtual 3s --hook throws
    said "task visual_servoing failed in cycle [0-9]*, phase .*: the law has no solution; the others were stopped safely"
    expect 1 visual_servoing --virtual 3s --hook hangs --patience 1s
    said "task visual_servoing hung in cycle [0-9]*, phase .*: no progress for 1000 ms of the wall clock; the others were stopped safely"
    expect 1 visual_servoing --virtual 3s --hook waits --patience 1s
    said "task visual_servoing hung in cycle [0-9]*, phase .*: no progress for 1000 ms of the wall clock; the others were stopped safely"
    expect 1 visual_servoing --real 3s --hook hangs
    said "task visual_servoing hung in cycle [0-9]*, phase .*: no progress for"
    expect 3 visual_servoing --virtual 3s --hook nan
    said "holding, without set-points"
    said "task visual_servoing made [0-9]* data that are not valid; they were not handed over"
    expect 2 visual_servoing --views "$out/missing"
    said "visual_servoing: --views: Directory does not exist: $out/missing"
    # A disk that is full: the verdict is there all the same.
    expect 2 visual_servoing --virtual 5s --run /dev/full
    said "converged"
    said "visual_servoing: /dev/full cannot be written: No space left on device"
}

object_tracking() {
    expect 0 object_tracking --virtual 3s --run "$out/run.json"
    said "pixels from the middle (bound 10): tracked"
    punctual
    recorded tracked
    expect 1 object_tracking --virtual 100ms
    said "not tracked"
    expect 0 object_tracking --virtual 1s --unplugged 300ms
    said "holding, nothing to follow"
}

pick_and_place() {
    expect 0 pick_and_place --virtual 12s --parts 1 --run "$out/run.json"
    said "1 of 1 parts placed, at most 0.[0-9]* mm from their places: in a row"
    punctual
    recorded in_a_row
    expect 1 pick_and_place --virtual 1s
    said "0 of 3 parts placed, .*: not in a row"
    expect 2 pick_and_place --parts 4
    said "pick_and_place: --parts: Value 4 not in range 1 to 3"
}

micro_assembly() {
    expect 0 micro_assembly --virtual 2500ms --run "$out/run.json"
    said "um and .* mrad from the substrate, .*: assembled"
    punctual
    recorded assembled
    # The same bytes each time.
    cp "$out/run.json" "$out/first.json"
    expect 0 micro_assembly --virtual 2500ms --run "$out/run.json"
    cmp "$out/first.json" "$out/run.json" || fail "another run for the same seed"
    expect 1 micro_assembly --virtual 200ms
    said "not assembled"
    expect 0 micro_assembly --virtual 1s --unplugged 100ms
    said "standing, without images"
    expect 2 micro_assembly --virtual 2500ms --run /dev/full
    said "assembled"
    said "micro_assembly: /dev/full cannot be written: No space left on device"
}

for program in "$@"; do "$program"; done
# The log is written all the time: a disk that is full ends the log alone.
case $1 in
pick_and_place) well="--virtual 13s --parts 1" ;;
*) well="--virtual 1s --unplugged 100ms" ;;
esac
# shellcheck disable=SC2086 # several words
expect 3 "$1" $well --log /dev/full
said "the log ended early: No space left on device"

# In real time how well they do depends on the machine; that they run, and end, does not.
for program in "$@"; do
    code=0
    "$build"/*/*/$program --real 500ms --log "$out/run.mcap" >"$out/said" 2>&1 || code=$?
    case $code in 0 | 1 | 3) ;; *) fail "exit code $code: $program --real" ;; esac
    said "^encoder \|^scales_reader "
    [ -s "$out/run.mcap" ] || fail "no log"
done

# Wrong usage, and a world that does not play along.
for program in "$@"; do
    expect 2 $program --vertual 1s
    said "$program: The following argument.* not expected: .*--vertual"
    expect 2 $program --virtual soon
    said "$program: --virtual: 'soon' is no time above 0 and up to an hour, as 10s, 0.5s, 20ms"
    expect 2 $program --uneven --real 1s
    said "$program: --.* excludes --"
    expect 2 $program --virtual 1s --real 1s
    said "$program: --.* excludes --"
    expect 2 $program --seed -3
    said "$program: --seed: '-3' is no whole number"
    expect 2 $program --run "$out/missing/run.json"
    said "$program: $out/missing/run.json cannot be written: No such file or directory"
    expect 2 $program --log "$out/missing/run.mcap"
    said "$program: $out/missing/run.mcap cannot be written: No such file or directory"
    expect 0 $program --help
    said "--virtual TIME"
done

echo "programs: verdicts, exit codes and complaints of $* are as they should be"
