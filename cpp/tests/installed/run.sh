#!/bin/sh
# Installs the runtime, finds it as a package from a project elsewhere, builds that and runs it.
# Usage: run.sh BUILT FOLDER COMPILER, where BUILT was configured from cpp/.
set -eu
here=$(dirname "$0")
rm -rf "$2"
cmake --install "$1" --prefix "$2/prefix" >/dev/null
cmake -S "$here" -B "$2/build" -DCMAKE_PREFIX_PATH="$2/prefix" -DCMAKE_CXX_COMPILER="$3" >/dev/null
cmake --build "$2/build" >/dev/null
"$2/build/user"
