#!/bin/sh
# Mutates models and compares with what is expected: how many mutants the properties kill, and how many survive. Arguments:
# groundstate's path, and lists of expectations. The paths in a list are seen from its folder.
# A line: what is mutated; which models judge it, or options of `mutate`; what comes out. Without both, the model judges itself.
set -u
[ $# -ge 2 ] || { echo "usage: mutants.sh GROUNDSTATE LIST…" >&2; exit 2; }
groundstate=$(realpath "$1")
shift
wrong=0

# expect MUTATED JUDGES COUNTS
expect() {
	case $2 in
	*--*) options=$2 ;;
	*)
		options="--with verify --time 600"
		for judge in $2; do options="$options --by $judge"; done
		;;
	esac
	# shellcheck disable=SC2086 # the options are several words
	count=$("$groundstate" mutate "$1" $options </dev/null 2>/dev/null | grep ' killed (')
	count=$(echo "$count" | sed 's/ ([^)]*)//')
	if [ -n "$count" ] && [ "$count" = "${3# }" ]; then
		echo "right   $1${2:+,}$2: $count"
	else
		echo "WRONG   $1${2:+,}$2: $count instead of$3"
		wrong=1
	fi
}

for list in "$@"; do
	here=$PWD
	lines=$(grep -v -e '^#' -e '^$' "$list") && cd "$(dirname "$list")" || exit 1
	while IFS=';' read -r mutated judges counts; do
		expect "$mutated" "$judges" "$counts"
	done <<EOF
$lines
EOF
	cd "$here" || exit 1
done
exit $wrong
