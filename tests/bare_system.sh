#!/bin/sh
# bare_system.sh ROOT [RELEASE]: a bare Debian in the folder ROOT, 12 (bookworm) if no other release is
# named, from the package source that this machine uses. Needs root and debootstrap.
set -eu
mirror=$(sed -n 's/^URIs: *//p; s/^deb \(\[.*\] \)*\([^ ]*\) .*/\2/p' \
  /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null | head -n 1)
log=$(mktemp)
debootstrap --variant=minbase "${2:-bookworm}" "$1" "$mirror" >"$log" || { tail "$log" >&2; exit 1; }
rm -f "$log"
cp /etc/apt/apt.conf.d/* "$1/etc/apt/apt.conf.d/" 2>/dev/null || true
cp /etc/resolv.conf "$1/etc/resolv.conf" 2>/dev/null || true
