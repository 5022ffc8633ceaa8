#!/bin/sh
# lock.sh OUT MAKE alone|shared: one make at a time on one OUT. A process in the background holds a
# lock on OUT/stages/.lock for as long as the process MAKE lives, however that ends; the system
# releases the lock with it. Shards share the folder with one another (shared) and with nobody else.
# Prints who has the lock where it is taken, else nothing.
set -eu
out=$1 make=$2 how=$3
lock=$out/stages/.lock
command -v flock >/dev/null 2>&1 && mkdir -p "$out/stages" 2>/dev/null || exit 0
if [ -L "$lock" ]; then
  echo "$lock is a link, expected the lock of make: remove it"
  exit 0
fi
# A network file system locks only a file that is open for writing; other users may read the lock of
# a user.
(umask 0; : >>"$lock") 2>/dev/null || true
if (: 9<>"$lock") 2>/dev/null; then exec 9<>"$lock"
elif (: 9<"$lock") 2>/dev/null; then exec 9<"$lock"
else exit 0; fi

# The lock of a make that has ended is free within a fifth of a second. A shard also waits for the
# make that has sent it.
case $how in
  shared) kind=-s wait_s=60 ;;
  *) kind=-x wait_s=2 ;;
esac
if ! flock $kind -w $wait_s 9; then
  read -r holder on since <"$lock" || true
  echo "another make works in $out: process ${holder:-?} on ${on:-?}, since ${since:-?}:" \
    "wait for it, end it, or name another folder: make OUT=..."
  exit 0
fi
printf '%-99s\n' "$make $(uname -n) $(date '+%Y-%m-%d %H:%M:%S')" 2>/dev/null >&9 || true
(trap '' HUP INT TERM && exec tail --pid="$make" -s 0.2 -f /dev/null) >/dev/null 2>&1 </dev/null &
