#!/bin/sh
# Runs a command and says how long it took. Usage: xtask/timed.sh NAME COMMAND…; without arguments: the table of all that were run
# since `xtask/timed.sh --begin`.
set -u
times="$(dirname "$0")/../target/times"
show() { awk -F'\t' '{ printf "  %-12s %3d min %02d s\n", $1, $2 / 60, $2 % 60 }' "$times"; }
case ${1-} in
'') show; exit ;;
--begin)
    mkdir -p "$(dirname "$times")"
    : >"$times"
    exit ;;
esac
name=$1
shift
begin=$(date +%s)
code=0
"$@" || code=$?
printf '%s\t%s\n' "$name" $(($(date +%s) - begin)) >>"$times"
exit $code
