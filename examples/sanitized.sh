#!/bin/sh
# Builds the applications' programs under a sanitizer and runs their closed loops for a short time, in virtual time, where
# the verdict must be the same as without, and in real time, where all threads run at once. Usage: examples/sanitized.sh
# thread|address PROGRAM…, from anywhere; the packages are robot.sh's. There are no suppressions: OpenCV is not
# instrumented, but computes in the calling thread (vision/disc_detector.hpp), so that it hides nothing from the judge.
set -eu
cd "$(dirname "$0")"
sanitizer=$1
shift
build=../target/cpp/robot-$sanitizer
said=$(mktemp)
trap 'rm -f "$said" "$said.mcap"' EXIT

cmake -S . -B "$build" -G Ninja -DGROUNDSTATE_SANITIZER="$sanitizer" -DCMAKE_CXX_FLAGS=-O0 -DGROUNDSTATE_SEEDED_FAULTS=ON >/dev/null
cmake --build "$build" --target "$@" -- --quiet

# A code of its own for what a sanitizer finds, whatever the verdict.
export TSAN_OPTIONS=exitcode=66:halt_on_error=1 ASAN_OPTIONS=exitcode=66 UBSAN_OPTIONS=print_stacktrace=1:exitcode=66

# expect CODES PROGRAM ARGUMENT…
expect() {
    wanted=$1
    program=$2
    shift 2
    code=0
    timeout 300 "$build"/*/*/"$program" "$@" --patience 20s >"$said" 2>&1 || code=$?
    case " $wanted " in *" $code "*) ;; *)
        cat "$said"
        echo "examples/sanitized.sh: exit code $code instead of $wanted under the $sanitizer sanitizer: $program $*" >&2
        exit 1 ;;
    esac
}

for program in "$@"; do
    case $program in
    visual_servoing) span="5s --noise --dropped --slow --occlusion" ;;
    object_tracking) span="2s --noise --dropped" ;;
    pick_and_place) span="12s --parts 1" ;;
    micro_assembly) span="2500ms --noise" ;;
    esac
    # shellcheck disable=SC2086 # several words
    expect 0 "$program" --virtual $span --log "$said.mcap"
    expect "0 1 3" "$program" --real 2s --log "$said.mcap"
done
case " $* " in *" visual_servoing "*)
    expect 1 visual_servoing --virtual 2s --hook throws
    expect 0 visual_servoing --virtual 2s --unplugged 500ms ;;
esac
echo "sanitized: nothing found by the $sanitizer sanitizer in $*"
