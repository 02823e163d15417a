#!/bin/sh
# Verifies the machines of robots' components by themselves, whatever they may read, and looks for the faults that it puts in: in
# machines, which their properties find, and between them, which scenarios of the whole robot find. Usage: examples/machines.sh
# GROUNDSTATE [PROGRAM…], from anywhere; without a program named it is all.
set -eu
groundstate=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- visual_servoing pick_and_place object_tracking micro_assembly press_cell
cd "$(dirname "$0")"
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT
# The libraries are found beside the examples.
mkdir -p "$out/examples"
ln -s "$(realpath ../library)" "$out/library"

# expect CODE WORDS COMMAND…: that exit code, and those words in what it says.
expect() {
    wanted=$1
    words=$2
    shift 2
    code=0
    "$@" >"$out/said" 2>&1 || code=$?
    [ "$code" = "$wanted" ] && grep -q -- "$words" "$out/said" || {
        cat "$out/said"
        echo "examples/machines.sh: exit code $code, $wanted and \"$words\" wanted: $*" >&2
        exit 1
    }
}

# seeded FILE OLD NEW: a copy of the robot's models with another text, in $robot.
seeded() {
    robot=$out/examples/seeded
    rm -rf "$robot"
    mkdir "$robot"
    cp "$program"/*.asm "$program"/*.chart "$program"/*.avalla "$program"/*.yaml "$robot"
    python3 -c '
import sys
file, old, new = sys.argv[1:]
text = open(file).read()
assert text.count(old) >= 1, f"{file} has no such text: {old}"
open(file, "w").write(text.replace(old, new, 1))
' "$robot/$1" "$2" "$3"
}

# found PROPERTY FILE OLD NEW: the fault in the machine violates the property.
found() {
    seeded "$2" "$3" "$4"
    expect 1 "^violated  $1" "$groundstate" verify "$robot/$2" --quiet
}

# fails SCENARIO FILE OLD NEW: the fault in the machine makes the scenario of the whole robot fail.
fails() {
    seeded "$2" "$3" "$4"
    expect 0 "" "$groundstate" chart build "$robot/$chart.chart"
    expect 1 "^FAIL $1" "$groundstate" test "$robot/$1.avalla"
}

# holds CHART MACHINE…: the machines do, whatever they read, before the first datum of a channel too; and the model of the robot is made of them.
holds() {
    chart=$1
    expect 0 "" "$groundstate" chart check "$program/$chart.chart"
    shift
    for machine in "$@"; do
        expect 0 "^holds " "$groundstate" verify "$program/$machine.asm"
    done
}

visual_servoing() {
    holds ControllerSystem Servoing Arm
    found ltlSpec_guides Servoing.asm "hasLaw, 0]" "true, 0]"
    found ltlSpec_guides Servoing.asm "else SEARCHING endif, false" "else SEARCHING endif, hasLaw"
    found ltlSpec_known Servoing.asm "isFollowing and unseen < patience" "unseen < patience"
    found ltlSpec_atOnce Servoing.asm "if isSeen then" "if isSeen and panel != LOST then"
    found ltlSpec_converged Servoing.asm "isClose and hasLaw then" "isClose then"
    found ctlSpec_counts Servoing.asm "COVERED, hasLaw, unseen + 1" "COVERED, hasLaw, max(unseen, 1)"
    found ltlSpec_lost Servoing.asm "isFollowing or panel = LOST then LOST" "panel != WITHOUT_TARGET then LOST"
    found inv_unseen Servoing.asm "false, 0]
				endif" "false, unseen]
				endif"
    found ltlSpec_target Servoing.asm "if not hasTarget then" "if not hasTarget and not isFollowing then"
    found ltlSpec_guided Arm.asm "if isGuided then" "if isGuided and arm != STOPPING then"
    found ltlSpec_stops Arm.asm "if arm = FOLLOWING or arm = STOPPING" "if arm = STOPPING"
    found ltlSpec_rests Arm.asm "arm = STOPPING and not isStill then" "arm = STOPPING and isStill then"
    found ctlSpec_patient Servoing.asm "patience = 10" "patience = 9"
    # The scenario of the whole robot tells, too, for how many images discs are made up for.
    fails ControllerModes Servoing.asm "patience = 10" "patience = 9"
    # A rule written by hand that decides in the machine's place.
    seeded ControllerSystem.asm "sb_staged(vs_to_robot) := sb_received(camera_to_vs)" "guiding := true"
    expect 1 "updates \`guiding\`, which is for the machines of components alone" "$groundstate" chart check "$robot/$chart.chart"
}

pick_and_place() {
    holds PlacingSystem Planner Robot Gripper
    found ltlSpec_held Planner.asm "if second(progress) then r_send[CARRY] else r_send[REOPEN] endif" "r_send[CARRY]"
    found ltlSpec_oneMove Planner.asm "and first(progress) = number" ""
    found ltlSpec_seen Planner.asm "images := 0" "images := old"
    found inv_room Planner.asm "sight and placed < places" "sight"
    found ltlSpec_gripped Planner.asm "case OVER: r_send[DOWN]" "case OVER: r_send[CLOSE]"
    found ltlSpec_keeps Robot.asm "if second(moves) = OPEN or" "if second(moves) = RISE or"
    found ltlSpec_honest Robot.asm "if isDone then progress" "if not isDone then progress"
    found ltlSpec_holds Robot.asm "(number, grip = HOLDING)" "(number, move = CLOSE)"
    found inv_holds Gripper.asm "if valve then" "if jaw != WIDE then"
    found ltlSpec_felt Gripper.asm "case SHUT: grip := EMPTY" "case SHUT: grip := HOLDING"
    found ltlSpec_opens Gripper.asm "and jaw_order != valve" "and jaw_order"
    # Each machine is right by itself: what the gripper says while the jaw is on its way must not be taken for an end.
    fails OnePart Robot.asm "grip = EMPTY or grip = HOLDING" "grip = EMPTY or grip = HOLDING or grip = BUSY"
    fails EmptyGrip Robot.asm "progress := (number, grip = HOLDING)" "progress := (number, jaw_order)"
    fails OnePart Planner.asm "case LOWER: r_send[OPEN]" "case LOWER: r_send[RISE]"
}

object_tracking() {
    holds TrackingSystem Tracker Head
    found ltlSpec_lost Tracker.asm "mode = SEARCHING or isGivenUp" "mode = SEARCHING"
    found ltlSpec_keeps Tracker.asm "not found and aim != FOLLOWING" "not found"
    found ltlSpec_known Tracker.asm "mode = SEARCHING or isGivenUp" "isGivenUp"
    found ltlSpec_honest Tracker.asm "sight := found" "sight := mode != SEARCHING"
    # Before the first datum of the head.
    found ltlSpec_lost Tracker.asm "not found and aim != FOLLOWING" "not found and aim = HOLDING"
    found ltlSpec_follows Head.asm "isNewSight and sight" "isNewSight"
    found ctlSpec_counts Head.asm "isNewSight and sight" "isDef(sight) and sight"
    found inv_patience Head.asm "if unseen + 1 = patience then aim := HOLDING endif" "skip"
    found ltlSpec_givesUp Head.asm "unseen := unseen + 1" "unseen := if unseen + 2 = patience then unseen else unseen + 1 endif"
    found ctlSpec_atOnce Head.asm "aim := FOLLOWING" "aim := if unseen = patience then aim else FOLLOWING endif"
    found ctlSpec_patient Head.asm "patience = 60" "patience = 50"
    # How long the head waits shows in the whole robot, too.
    fails Lost Head.asm "patience = 60" "patience = 50"
}

# staged PROPERTY OLD NEW: the same of the stage; if it waits for fewer cycles, it has fewer states and is wrong in the same way.
staged() {
    seeded Stage.asm "$2" "$3"
    sed -i "s/patience = 50/patience = 3/" "$robot/Stage.asm"
    expect 1 "^violated  $1" "$groundstate" verify "$robot/Stage.asm" --quiet
}

micro_assembly() {
    holds AssemblySystem Supervisor Aligner Stage
    found ltlSpec_aligned Supervisor.asm "if state = ALIGNED then" "if state = ALIGNING then"
    found ltlSpec_done Supervisor.asm "if state = PLACED then" "if isDef(state) then"
    found ctlSpec_retracted Supervisor.asm "if state = RETRACTED then r_end[FAILED] else r_goOn[] endif" "r_goOn[]"
    found ltlSpec_together Aligner.asm "right := 0
				guidance := (work, if" "guidance := (work, if"
    found ltlSpec_together Aligner.asm "marked and crossed" "crossed"
    found ltlSpec_seen Aligner.asm "(recipe, if marked then APART else HIDDEN endif)" "(recipe, APART)"
    found ltlSpec_obeys Aligner.asm "work := recipe" "skip"
    staged ctlSpec_overload "state = RETRACTING or contact = OVERLOAD" "contact = OVERLOAD"
    staged ctlSpec_overload "state = RETRACTING or contact = OVERLOAD" "state = RETRACTING or contact = OVERLOAD and state != PLACED"
    staged ltlSpec_gentle "isNewContact and contact = FREE then DOWN" "contact = FREE then DOWN"
    staged ltlSpec_placed "case LOWER: r_lower[]" "case REST: r_lower[]"
    staged ltlSpec_sighted "and (isSeen or unseen < patience)" ""
    staged ltlSpec_follows "(isSeen or unseen < patience)" "isSeen and unseen < patience"
    staged ltlSpec_corrects "isNewGuidance and second(guidance) != HIDDEN" "isNewGuidance"
    staged ltlSpec_up "if isUp then" "if not isUp then"
    # Images do not come so fast.
    fails OnePart Stage.asm "patience = 50" "patience = 5"
}

# drawn PROPERTY OLD NEW: the fault in the drawn controller violates the property.
drawn() {
    seeded Press.chart "$2" "$3"
    expect 0 "" "$groundstate" chart build "$robot/Press.chart"
    expect 1 "^violated  $1" "$groundstate" verify "$robot/Press.asm" --quiet
}

press_cell() {
    expect 0 "" "$groundstate" chart check "$program/Press.chart"
    holds PressCell Gauge Press
    expect 0 "^holds     inv_age1_height_to_motor" "$groundstate" verify "$program/PressCell.chart"
    expect 0 "^holds     ag(ef(controller_command = LOWER))" "$groundstate" verify "$program/PressCell.chart"
    expect 0 "2 passed" "$groundstate" test "$program"
    # A path at one of the states only does not come before its other paths.
    drawn "no inconsistent update" "working -> danger" "lowering -> danger"
    drawn ctlSpec_still "Curtain broken\" {curtain}" "Curtain broken\" {curtain and mode = LOWERING}"
    drawn ltlSpec_lowersOn "		history
" ""
    drawn inv_moves "		entry lampOn \"LAMP ON\" {lamp := true}
" ""
    drawn ltlSpec_down "begin -> lowering" "begin -> raising"
    # A press that begins where the last stroke ended goes down once only.
    drawn ctlSpec_lowers "begin -> lowering" "begin -> working"
    found ctlSpec_still Press.asm "if curtain or mode = IDLE or" "if mode = IDLE or"
    # A channel whose type has the name of a domain; a class of the user that decides otherwise.
    cell=$out/examples/cell
    cp -r "$program" "$cell"
    expect 0 "" "$groundstate" generate cpp "$cell/PressCell.chart" -o "$cell/cell"
    (
        cd "$cell/cell"
        g++ -std=c++20 -O0 -Wall -Wextra -Wconversion -Wpedantic -Wshadow -Werror -I . -I generated/include main.cpp \
            generated/machines/*.cpp -o press_cell -pthread
        expect 0 "" ./press_cell --virtual 1 --log run.mcap
        expect 0 "conforms tick by tick" "$groundstate" conform ../PressCell.asm run.mcap
        grep -q "^300 decisions are those of the components' machines" "$out/said"
    )
}

for program in "$@"; do "$program"; done

echo "machines: those of $* are proved, and each fault was found"
