#!/bin/sh
# Generates the tasks and machines of robots whose components decide by machines of their own, beside their hooks: a file is
# written only if it changes. Usage: examples/generated.sh GROUNDSTATE PROGRAM…, from anywhere.
set -eu
groundstate=$(realpath "$1")
shift
cd "$(dirname "$0")"
out=
trap '[ -z "$out" ] || rm -r "$out"' EXIT

# generate CHART FOLDER: the runtime is that of ../cpp; maps are for the tool alone. What is generated names models by paths from where
# it lies, so it is first written beside the folder.
generate() {
    out=$(mktemp -d "$(dirname "$2")/.generated.XXXXXX")
    "$groundstate" generate cpp "$1" -o "$out" >"$out/said" || {
        cat "$out/said" >&2
        exit 1
    }
    rm -r "$out/generated/include"
    (cd "$out/generated" && find . -name '*.?pp') | while read -r file; do
        mkdir -p "$(dirname "$2/generated/$file")"
        cmp -s "$out/generated/$file" "$2/generated/$file" || cp "$out/generated/$file" "$2/generated/$file"
    done
    rm -r "$out"
    out=
}

for program in "$@"; do
    case $program in
    visual_servoing) generate visual_servoing/ControllerSystem.chart visual_servoing/robot ;;
    pick_and_place) generate pick_and_place/PlacingSystem.chart pick_and_place/arm ;;
    object_tracking) generate object_tracking/TrackingSystem.chart object_tracking/head ;;
    micro_assembly) generate micro_assembly/AssemblySystem.chart micro_assembly/stage ;;
    esac
done
