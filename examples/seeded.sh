#!/bin/sh
# Puts faults of the runtime into the robot: a lock not taken, indexes not swapped, a stale reading, a watchdog ignored. Each
# must be found by `groundstate conform`. Usage: examples/seeded.sh BUILD GROUNDSTATE, from anywhere; BUILD has visual_servoing
# with GROUNDSTATE_SEEDED_FAULTS. Nobody waits too long in this robot unless a phase takes too long: hence --uneven.
set -eu
build=$(realpath "$1")
groundstate=$(realpath "$2")
cd "$(dirname "$0")"
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

for fault in 1 2 3 4; do
    "$build"/*/*/visual_servoing --virtual 500ms --uneven --patience 20s --seed-fault $fault --log "$out/run.mcap" \
        >"$out/said" 2>&1 || [ $? = 1 ] || { cat "$out/said"; exit 1; }
    code=0
    "$groundstate" conform visual_servoing/ControllerSystem.asm "$out/run.mcap" >"$out/said" 2>&1 || code=$?
    [ $code = 1 ] && grep -q "^parts " "$out/said" || {
        cat "$out/said"
        echo "examples/seeded.sh: fault $fault was not found: exit code $code" >&2
        exit 1
    }
done
grep -q "the model: gives_up" "$out/said" || { cat "$out/said"; exit 1; }
echo "seeded: each fault of the runtime was found in what the robot did"
