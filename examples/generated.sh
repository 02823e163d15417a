#!/bin/sh
# Generates the tasks and machines of robots whose components decide by machines of their own, beside their hooks: a file is
# written only if it changes. Usage: examples/generated.sh GROUNDSTATE PROGRAM…, from anywhere.
set -eu
groundstate=$(realpath "$1")
shift
cd "$(dirname "$0")"
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT

# generate CHART FOLDER: the runtime is that of ../cpp; maps are for the tool alone.
generate() {
    rm -rf "$out/program"
    "$groundstate" generate cpp "$1" -o "$out/program" >"$out/said" || {
        cat "$out/said" >&2
        exit 1
    }
    rm -r "$out/program/generated/include"
    (cd "$out/program/generated" && find . -name '*.?pp') | while read -r file; do
        mkdir -p "$(dirname "$2/generated/$file")"
        cmp -s "$out/program/generated/$file" "$2/generated/$file" || cp "$out/program/generated/$file" "$2/generated/$file"
    done
}

for program in "$@"; do
    case $program in
    pick_and_place) generate pick_and_place/PlacingSystem.chart pick_and_place/arm ;;
    object_tracking) generate object_tracking/TrackingSystem.chart object_tracking/head ;;
    micro_assembly) generate micro_assembly/AssemblySystem.chart micro_assembly/stage ;;
    esac
done
