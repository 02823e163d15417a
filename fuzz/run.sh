#!/bin/sh
# Runs every fuzz target for a while, guided by coverage: a build of its own. Usage: fuzz/run.sh [SECONDS]. The work is done
# by `cargo xtask fuzz`, here as the tests have built it.
set -eu
cd "$(dirname "$0")/.."
exec cargo run --quiet --locked --package xtask -- fuzz --seconds "${1:-20}"
