#!/bin/sh
# Opens a log with what viewers of MCAP files are made of: the reader of Foxglove's makers; with --rerun also Rerun itself,
# a large download. Usage: cpp/systems/viewers/run.sh FILE [--rerun], from anywhere. What is missing is installed under
# target/.
set -eu
log=$(realpath "$1")
cd "$(dirname "$0")"
mkdir -p ../../../target/viewers
target=$(realpath ../../../target/viewers)

cp package.json package-lock.json read.mjs "$target"
(cd "$target" && npm ci --silent --no-audit --no-fund && node read.mjs "$log")

if [ "${2:-}" = --rerun ]; then
    [ -x "$target/rerun/bin/rerun" ] || {
        python3 -m venv "$target/rerun"
        "$target/rerun/bin/pip" install --quiet rerun-sdk==0.41.0
    }
    "$target/rerun/bin/rerun" mcap check --full "$log"
    "$target/rerun/bin/rerun" mcap convert "$log" -o "$target/log.rrd"
    "$target/rerun/bin/rerun" rrd verify "$target/log.rrd"
fi
