#!/bin/sh
# clean_machine.sh [FOLDER]: runs both commands of README.md in a bare Debian 12 made by debootstrap
# in FOLDER (default: a temporary one), and prints how long each took. Needs root, debootstrap and the
# package source that this machine uses. Not part of the normal tests.
set -eu
cd "$(dirname "$0")/.."
checkout=$PWD
[ "$(id -u)" -eq 0 ] || { echo "clean_machine.sh: needs root, for chroot" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "clean_machine.sh: install debootstrap first" >&2; exit 1; }

root=${1:-$(mktemp -d)}
mirror=$(sed -n 's/^URIs: *//p; s/^deb \(\[.*\] \)*\([^ ]*\) .*/\2/p' /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null | head -n 1)
[ -x "$root/bin/sh" ] || debootstrap --variant=minbase bookworm "$root" "$mirror" >/dev/null
cp /etc/apt/apt.conf.d/* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
cp /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
rm -rf "$root/talus"
git -c safe.directory='*' clone -q "$checkout" "$root/talus"

mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
timed() {
  before=$(date +%s)
  chroot "$root" sh -c "cd /talus && $1" >"$root/log" 2>&1 || { tail -n 40 "$root/log" >&2; echo "FAILED: $1" >&2; exit 1; }
  echo "$1: $(($(date +%s) - before)) s"
}
timed "sh pipelines/demo.sh"
timed "sh pipelines/demo.sh # a second time"
timed "sh tests/run.sh"
