#!/bin/sh
# Holds what applications' programs did to their models, with `groundstate conform`: undisturbed and disturbed; and wants a log
# that tells a swap of visual_servoing wrongly to be found out. Usage: examples/held.sh BUILD GROUNDSTATE PROGRAM…, from anywhere.
set -eu
build=$(realpath "$1")
groundstate=$(realpath "$2")
shift 2
cd "$(dirname "$0")"
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

# record PROGRAM OPTIONS…: a run with a log; in so short a time it need not come where it has to.
record() {
    program=$1
    shift
    "$build"/*/*/"$program" "$@" --log "$out/run.mcap" >/dev/null || [ $? = 1 ]
}

# hold CODE MODEL LOG WORDS: `groundstate conform` gives that exit code and says that.
hold() {
    code=0
    "$groundstate" conform "$2" "$out/$3" >"$out/said" 2>&1 || code=$?
    [ "$code" = "$1" ] && grep -q "$4" "$out/said" || {
        cat "$out/said"
        echo "examples/held.sh: conform $2: exit code $code, $1 and \"$4\" wanted" >&2
        exit 1
    }
}

# exchanged EVENT LOG WRONG: writes the log with the two arrays of an event exchanged, and checksums that are right.
exchanged() {
    python3 -c '
import re, struct, sys, zlib
event, log, wrong = sys.argv[1:]
data = bytearray(open(log, "rb").read())
found = re.search(re.escape(event.encode()) + rb"(\d),\"next\":(\d)", data)
assert found, "no such event"
data[found.start(1)], data[found.start(2)] = data[found.start(2)], data[found.start(1)]
at = 8
while at < len(data) - 8:
    kind, length = data[at], struct.unpack_from("<Q", data, at + 1)[0]
    if kind == 6:
        name = struct.unpack_from("<I", data, at + 9 + 28)[0]
        records = at + 9 + 28 + 4 + name + 8
        struct.pack_into("<I", data, at + 9 + 24, zlib.crc32(data[records:at + 9 + length]))
    if kind == 15:
        struct.pack_into("<I", data, at + 9, zlib.crc32(data[:at]))
    at += 9 + length
open(wrong, "wb").write(data)
' "$@"
}

visual_servoing() {
    record visual_servoing --virtual 2s
    hold 0 visual_servoing/ControllerSystem.asm run.mcap "conforms by the order of events"
    exchanged '"kind":"swaps","object":"vs_to_robot","number":9,"array":' "$out/run.mcap" "$out/wrong.mcap"
    hold 1 visual_servoing/ControllerSystem.asm wrong.mcap "visual_servoing did: swaps vs_to_robot, number 9"
    record visual_servoing --virtual 1s --dropped --slow --occlusion --noise
    hold 0 visual_servoing/ControllerSystem.asm run.mcap "conforms by the order of events"
    record visual_servoing --virtual 1s --uneven
    hold 0 visual_servoing/ControllerSystem.asm run.mcap "conforms by the order of events"
}
object_tracking() {
    record object_tracking --virtual 1s
    hold 0 object_tracking/TrackingSystem.asm run.mcap "decisions are those of the components' machines"
}
pick_and_place() {
    record pick_and_place --virtual 1s
    hold 0 pick_and_place/PlacingSystem.asm run.mcap "decisions are those of the components' machines"
}
micro_assembly() {
    record micro_assembly --virtual 1s
    hold 0 micro_assembly/AssemblySystem.asm run.mcap "decisions are those of the components' machines"
}
for program in "$@"; do "$program"; done

echo "held: what $* did is what their models say"
