#!/bin/sh
# Verifies models of library/verification and compares with what is expected: whether everything holds, of how many states,
# and whether each seeded fault is found by the properties that are there to find it. Arguments: groundstate's path, and
# files of expectations.
set -u
case $1 in */*) groundstate=$(cd "$(dirname "$1")" && pwd)/$(basename "$1") ;; *) groundstate=$1 ;; esac
shift
cd "$(dirname "$0")" || exit 1

output=$(mktemp)
list=$(mktemp)
trap 'rm -f "$output" "$list"' EXIT
wrong=0

complain() {
	echo "WRONG   $model $options: $1"
	wrong=1
}

cat "$@" >"$list" || exit 1
while IFS=';' read -r model options expected; do
	case $model in '#'* | '') continue ;; esac
	# shellcheck disable=SC2086 # the options are several words
	"$groundstate" verify "$model" $options >"$output" 2>/dev/null </dev/null
	code=$?
	before=$wrong
	wrong=0
	# shellcheck disable=SC2086
	set -- $expected
	if [ "$1" = holds ]; then
		states=$2
		shift 2
		[ "${1-}" = but ] && shift
		[ $code -eq $(($# > 0)) ] || complain "exit code $code instead of $(($# > 0))"
		# A violation that is told while the search goes on is named again at the end.
		[ "$(grep '^\(violated\|unknown\)' "$output" | grep -cv ', as shown above$')" -eq $# ] ||
			complain "not everything else holds"
		grep -q "^$states states (all reachable)" "$output" ||
			complain "$(grep -o '^[0-9]* states ([^)]*)' "$output") instead of $states"
	else
		[ $code -eq 1 ] || complain "exit code $code instead of 1"
	fi
	for property; do
		grep -q "^violated  $property," "$output" || complain "$property is not found violated"
	done
	[ $wrong -eq 0 ] && echo "right   $model $options:$expected"
	[ $before -eq 1 ] && wrong=1
done <"$list"
exit $wrong
