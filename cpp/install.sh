#!/bin/sh
# Installs the Debian packages named that are missing, and says so first. Usage: cpp/install.sh PACKAGE...
# Where there is no apt-get the packages are for the user to bring: it says which, and goes on.
set -eu
export DEBIAN_FRONTEND=noninteractive

if ! command -v apt-get >/dev/null; then
    echo "cpp/install.sh: no apt-get here; needed, by their Debian names: $*" >&2
    exit 0
fi
look() {
    missing=
    for package in "$@"; do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
    done
}
look "$@"
[ -n "$missing" ] || exit 0

# `make test` calls this twice at once: the lists have a lock that nobody waits for.
exec 9>"${TMPDIR:-/tmp}/groundstate-install-$(id -u)"
flock 9
look "$@"
[ -n "$missing" ] || exit 0

as_root=$([ "$(id -u)" = 0 ] || echo sudo)
install() {
    # One at a time, whoever else installs on this machine.
    $as_root apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends $missing
}
echo "installing$missing"
# The lists may be older than the archive, or not be there at all.
install >/dev/null 2>&1 || { $as_root apt-get update >/dev/null && install; }
