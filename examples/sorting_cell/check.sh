#!/bin/sh
# Takes the sorting cell from its chart to a program that conforms, and puts in faults, each of which must be found: in the machines by
# their properties, in the composed model by the scenarios, in the program by `conform`. Usage: check.sh GROUNDSTATE [whole], from anywhere.
set -eu
groundstate=$(realpath "$1")
cd "$(dirname "$0")"
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT
# The libraries are found beside the examples.
mkdir -p "$out/examples"
ln -s "$(realpath ../../library)" "$out/library"

fail() {
    echo "examples/sorting_cell/check.sh: $*" >&2
    exit 1
}

# expect CODE WORDS COMMAND…: that exit code, and those words in what it says.
expect() {
    wanted=$1
    words=$2
    shift 2
    code=0
    "$@" >"$out/said" 2>&1 || code=$?
    [ "$code" = "$wanted" ] && grep -q -- "$words" "$out/said" || {
        cat "$out/said"
        fail "exit code $code, $wanted and \"$words\" wanted: $*"
    }
}

# seeded NAME FILE OLD NEW: a copy of the cell with another text, in $cell.
seeded() {
    cell=$out/examples/$1
    cp -r . "$cell"
    python3 -c '
import sys
file, old, new = sys.argv[1:]
text = open(file).read()
assert text.count(old) >= 1, f"{file} has no such text: {old}"
open(file, "w").write(text.replace(old, new, 1))
' "$cell/$2" "$3" "$4"
}

# found PROPERTY MACHINE [OPTION]: the seeded fault violates the property.
found() { expect 1 "^violated  $1" "$groundstate" verify "$cell/$2" --quiet ${3-}; }

# old BOUND: the seeded fault makes data older than that, as far as is known.
old() { expect 3 "^age $1: not shown within" "$groundstate" chart times "$cell/SortingCell.chart"; }

for machine in Camera Reader Classifier Encoder Sequencer LeftPusher RightPusher; do
    expect 0 "^holds " "$groundstate" verify $machine.asm
done
expect 0 "" "$groundstate" chart check SortingCell.chart

seeded staysOut LeftPusher.asm "remaining := remaining - 1" "remaining := remaining"
found ltlSpec_ordered LeftPusher.asm
seeded again RightPusher.asm "if isNewRightOrders and rightOrders" "if isDef(rightOrders) and rightOrders"
found ltlSpec_ordered RightPusher.asm
seeded deaf RightPusher.asm "isHalted or stop" "isHalted"
found ctlSpec_stopped RightPusher.asm
# What comes before the first datum of a channel: nothing.
seeded nothing Sequencer.asm "isDef(codes) and first(codes) = entering then" "first(codes) = entering then"
found "every guard and operation is defined" Sequencer.asm --first
seeded torn Camera.asm "labels := (\$parcel, printed)" "labels := (arrivals, printed)"
found inv_oneParcel Camera.asm

# Long proofs, which `make verify` asks for.
if [ "${2-}" = whole ]; then
    expect 0 "^holds     inv_age1_camera_to_sequencer (by the responses of its tasks, at most 55.1 ms)" "$groundstate" verify SortingCell.chart
    grep -q "^holds     inv_deadlines" "$out/said" || fail "the deadlines were not proved"
    seeded swapped Sequencer.asm "then END else code endif" "then END else if code = LEFT then RIGHT else LEFT endif endif"
    found ltlSpec_left Sequencer.asm
    seeded afterTheStop Sequencer.asm "leftOrders := false" "skip"
    found ctlSpec_stopped Sequencer.asm
    seeded unseen Sequencer.asm "arrivals != (arrived + 1) mod 6 or (isDef(entering) and not moved)" "isDef(entering) and not moved"
    found ltlSpec_apart Sequencer.asm
    seeded twice Sequencer.asm "entering) and bin = RIGHT" "entering) and bin != END"
    found ltlSpec_once Sequencer.asm
    seeded damaged Sequencer.asm "or shape != WHOLE" "or shape = undef"
    found ltlSpec_whole Sequencer.asm
    seeded another Sequencer.asm "isDef(codes) and first(codes) = entering then" "isDef(codes) then"
    found ltlSpec_left Sequencer.asm
fi

# What is wrong between the machines, each of which is right.
expect 0 "^age from camera to sequencer: at most 55.1 ms" "$groundstate" chart times SortingCell.chart
seeded slow SortingCell.chart "elaborate classify 8..20 ms" "elaborate classify 8..25 ms"
old "from camera to sequencer"
seeded late SortingCell.chart "elaborate classify 8..20 ms" "elaborate classify 60..80 ms"
expect 1 "is never as young as 60 ms: the phases alone take 64.6 ms" "$groundstate" chart build "$cell/SortingCell.chart"
sed -i "/^\twithin /d" "$cell/SortingCell.chart"
expect 0 "" "$groundstate" chart build "$cell/SortingCell.chart"
expect 1 "^FAIL LeftAndRight" "$groundstate" test "$cell/LeftAndRight.avalla"
seeded long SortingCell.chart "elaborate count 0.2 ms" "elaborate count 0.2..1.2 ms"
: >"$cell/SortingCell.verify.yaml"
expect 1 "^violated  inv_periods" "$groundstate" verify "$cell/SortingCell.chart" --first --quiet

# The program; on request its sequencer decides otherwise than its machine.
seeded program cell/sequencer.hpp "  private:" '    bool decide(const Cycle& cycle, const In& in, Out& out) override {
        const bool done = SequencerMachine::decide(cycle, in, out);
        if (std::getenv("OTHERWISE") != nullptr && out.leftOrders.value) {
            std::swap(out.leftOrders.value, out.rightOrders.value);
        }
        return done;
    }

  private:'
expect 0 "your files, left as they are" "$groundstate" generate cpp "$cell/SortingCell.chart" -o "$cell/cell"
cd "$cell/cell"
g++ -std=c++20 -O0 -Wall -Wextra -Wconversion -Wpedantic -Wshadow -Werror -I . -I generated/include main.cpp generated/machines/*.cpp \
    -o sorting_cell -pthread
expect 0 "17 pushes, 0 of them wrong, 0 after the stop; 16 parcels" ./sorting_cell --virtual 2 --log run.mcap
expect 0 "conforms tick by tick" "$groundstate" conform ../SortingCell.asm run.mcap
grep -q "^4903 decisions are those of the components' machines" "$out/said" || fail "not all decisions were replayed"
expect 0 "3 pushes, 0 of them wrong, 0 after the stop; 11 parcels" env STOP_MS=500 ./sorting_cell --virtual 1.5 --log run.mcap
expect 0 "conforms tick by tick" "$groundstate" conform ../SortingCell.asm run.mcap
# On a faster belt; on one that is faster than the classifier nothing is pushed, and no parcel is taken for another.
expect 0 "21 pushes, 0 of them wrong, 0 after the stop; 21 parcels" env STEP_MS=60 ./sorting_cell --virtual 2 --log run.mcap
expect 0 "conforms tick by tick" "$groundstate" conform ../SortingCell.asm run.mcap
expect 0 "^0 pushes, 0 of them wrong" env STEP_MS=15 ./sorting_cell --virtual 2
expect 0 ", 0 of them wrong" ./sorting_cell --virtual 1 --seed 3 --log run.mcap
expect 0 "conforms by the order of events" "$groundstate" conform ../SortingCell.asm run.mcap
expect 0 " [1-9][0-9]* of them wrong" env OTHERWISE=1 ./sorting_cell --virtual 1 --log run.mcap
expect 1 "sequencer decided leftOrders = false, its machine true, from .*codes = (0,LEFT)" "$groundstate" conform ../SortingCell.asm run.mcap

echo "sorting_cell: proved, tested, generated and run as its model says; every fault was found"
