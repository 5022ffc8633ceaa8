#!/bin/sh
# clean_machine.sh [FOLDER [RELEASE]]: runs both commands of README.md in a bare Debian made by
# debootstrap in FOLDER (default: a temporary one), 12 (bookworm) if no other RELEASE is named, and
# prints how long each took, by the clock and of the processors. Needs root, debootstrap and the
# package source that this machine uses. What users download is tried by try_release.sh. Not part of
# the normal tests.
set -eu
cd "$(dirname "$0")/.."
checkout=$PWD
[ "$(id -u)" -eq 0 ] || { echo "clean_machine.sh: needs root, for chroot" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "clean_machine.sh: install debootstrap first" >&2; exit 1; }

root=${1:-$(mktemp -d)}
trap 'umount "$root/dev/pts" "$root/proc" 2>/dev/null || true' EXIT
used() {  # sets `seconds`: processor time of all that has ended so far
  times >"$root/times"
  seconds=$(awk 'NR == 2 { gsub(/[ms]/, " "); print int($1 * 60 + $2 + $3 * 60 + $4) }' "$root/times")
}
# timed ROOT COMMAND
timed() {
  before=$(date +%s)
  used
  used_before=$seconds
  chroot "$1" sh -c "$2" >"$1/log" 2>&1 || { tail -n 40 "$1/log" >&2; echo "FAILED: $2" >&2; exit 1; }
  used
  echo "$2: $(($(date +%s) - before)) s, $((seconds - used_before)) s of processor time"
}
[ -x "$root/bin/sh" ] || sh tests/bare_system.sh "$root" ${2:+"$2"}
mount -t proc proc "$root/proc"
mkdir -p "$root/dev/pts"
mount -t devpts devpts "$root/dev/pts" -o newinstance,ptmxmode=666
rm -rf "$root/talus"
git -c safe.directory='*' clone -q "$checkout" "$root/talus"
timed "$root" "cd /talus && sh pipelines/demo.sh"
timed "$root" "cd /talus && make -C sample_sites/maungawhau clean && sh pipelines/demo.sh"
timed "$root" "cd /talus && sh tests/run.sh"
