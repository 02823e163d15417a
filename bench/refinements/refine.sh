#!/bin/sh
# Decides the public chains of refinements, and compares with expected.txt. Arguments: groundstate's path, and the root of a checkout of
# ASMETA's repository, of which only models are read. A model that is not there is a failure, and so is another answer than the expected one.
set -u
case $1 in */*) groundstate=$(cd "$(dirname "$1")" && pwd)/$(basename "$1") ;; *) groundstate=$1 ;; esac
corpus=$(cd "$2" && pwd) || exit 2
cd "$(dirname "$0")" || exit 2

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
output=$scratch/output
verdicts=$scratch/verdicts
: >"$verdicts"
folder=.

while IFS=';' read -r models arguments fault expected; do
	case $models in
	'#'* | '') continue ;;
	'in '*)
		folder=${models#in }
		continue
		;;
	esac
	abstract=$corpus/$folder/${models% *}.asm
	concrete=$corpus/$folder/${models#* }.asm
	question="$models${arguments:+ $arguments}${fault:+ with $fault}"
	if [ -n "$fault" ]; then
		# A copy with the fault, among copies of what it may import.
		rm -rf "$scratch/faulty"
		mkdir "$scratch/faulty"
		cp "$(dirname "$concrete")"/*.asm "$scratch/faulty"
		copy=$scratch/faulty/$(basename "$concrete")
		sed "$fault" "$concrete" >"$copy"
		if cmp -s "$concrete" "$copy"; then
			echo "WRONG   $question: there is nothing to change"
			echo wrong >>"$verdicts"
			continue
		fi
		concrete=$copy
	fi
	# shellcheck disable=SC2086 # the arguments are several words
	"$groundstate" refine "$abstract" "$concrete" $arguments --time 120 >"$output" 2>&1 </dev/null
	code=$?
	case $expected in
	'refines '*) wanted=0 line="${expected#refines } pairs\{0,1\} of " ;;
	'proved '*) wanted=0 line="  proved     by induction: ${expected#proved } obligation" ;;
	'refuted '*) wanted=1 line="does not refine: ${expected#refuted }" ;;
	'says nothing: '*) wanted=1 line="error.vacuous-refinement.: ${expected#says nothing: }" ;;
	'unknown '*) wanted=3 line="not known: ${expected#unknown }" ;;
	*) wanted=none line= ;;
	esac
	# A fault is found only by a run that shows it.
	[ -z "$fault" ] || [ "$wanted" = 1 ] || wanted=none
	if [ "$code" != "$wanted" ] || ! grep -q "^$line" "$output"; then
		echo "WRONG   $question: $expected, but exit code $code: $(head -n 1 "$output")"
		echo wrong >>"$verdicts"
	elif [ -n "$fault" ]; then
		echo "right   $question: $expected"
		echo fault >>"$verdicts"
	else
		echo "right   $question: $expected"
		echo "$folder $models ${expected%% *}" >>"$verdicts"
	fi
done <expected.txt

# A pair that is asked about more than once counts by its best answer: what one coupling refutes, another may prove.
awk '
	$1 == "fault" { faults++; next }
	$1 == "wrong" { wrong++; next }
	{
		worth = $4 == "refines" || $4 == "proved" ? 4 : $4 == "refuted" ? 3 : $4 == "says" ? 2 : 1
		pair = $1 " " $2 " " $3
		if (worth > best[pair]) best[pair] = worth
	}
	END {
		for (pair in best) { count[best[pair]]++; pairs++ }
		printf "%d pairs: %d refine, %d do not, %d say nothing, %d are not known; ", pairs, count[4], count[3], count[2], count[1]
		printf "%d faults that were put in are found; %d wrong answers\n", faults, wrong
		exit wrong > 0 || pairs == 0
	}' "$verdicts"
