#!/bin/sh
# Runs every fuzz target for a while. Usage: fuzz/run.sh [SECONDS]. The work is done by `cargo xtask fuzz`.
set -eu
cd "$(dirname "$0")/.."
exec cargo xtask fuzz --seconds "${1:-20}"
