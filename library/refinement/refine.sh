#!/bin/sh
# Proves refinements, and refutes their wrong siblings, and compares with what is expected: of how many pairs of states, by how many
# obligations, and for which reason. Arguments: groundstate's path, and files of expectations; each speaks of the models and couplings in
# its own folder.
set -u
case $1 in */*) groundstate=$(cd "$(dirname "$1")" && pwd)/$(basename "$1") ;; *) groundstate=$1 ;; esac
shift

output=$(mktemp)
trap 'rm -f "$output"' EXIT
wrong=0
here=$(pwd)

for list; do
	cd "$here" && cd "$(dirname "$list")" && [ -r "$(basename "$list")" ] || exit 1
	while IFS=';' read -r arguments expected; do
		case $arguments in '#'* | '') continue ;; esac
		# shellcheck disable=SC2086 # the arguments are several words
		"$groundstate" refine $arguments >"$output" 2>/dev/null </dev/null
		code=$?
		case $expected in
		'refines '*) wanted=0 line="${expected#refines } pairs of " ;;
		'refuted '*) wanted=1 line="does not refine: ${expected#refuted }" ;;
		'proved '*) wanted=0 line="  proved     by induction: ${expected#proved } obligations" ;;
		'unproved '*) wanted=3 line="not known: the induction fails at .${expected#unproved }" ;;
		*) wanted=none line= ;;
		esac
		if [ "$code" = "$wanted" ] && grep -q "^$line" "$output"; then
			echo "right   $arguments: $expected"
		else
			echo "WRONG   $arguments: $expected, but exit code $code: $(head -n 1 "$output")"
			wrong=1
		fi
	done <"$(basename "$list")"
done
exit $wrong
