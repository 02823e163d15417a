#!/bin/sh
# Mutates machines of library/patterns and compares with what is expected: how many mutants the properties of the models beside this
# file kill, and how many survive. Arguments: groundstate's path, and files of expectations.
set -u
case $1 in */*) groundstate=$(cd "$(dirname "$1")" && pwd)/$(basename "$1") ;; *) groundstate=$1 ;; esac
shift
cd "$(dirname "$0")" || exit 1

list=$(mktemp)
trap 'rm -f "$list"' EXIT
wrong=0

cat "$@" >"$list" || exit 1
while IFS=';' read -r mutated judges expected; do
	case $mutated in '#'* | '') continue ;; esac
	by=
	for judge in $judges; do by="$by --by $judge"; done
	# shellcheck disable=SC2086 # the judges are several words
	count=$("$groundstate" mutate "$mutated" $by --with verify </dev/null 2>/dev/null | grep ' killed (')
	count=$(echo "$count" | sed 's/ ([^)]*)//')
	if [ "$count" = "${expected# }" ]; then
		echo "right   $mutated by$judges: $count"
	else
		echo "WRONG   $mutated by$judges: $count instead of$expected"
		wrong=1
	fi
done <"$list"
exit $wrong
