#!/bin/sh
# lock.sh OUT MAKE alone|shared: one make at a time on one OUT. A process in the background holds a lock
# on OUT/stages/.lock for as long as the process MAKE lives, however that ends; the system releases the
# lock with it. Shards share the folder with one another (shared) and with nobody else. A make that was
# started by the one with the lock works under that lock. Prints who has the lock where it cannot be
# had, else nothing.
set -eu
out=$1 make=$2 how=$3
lock=$out/stages/.lock
command -v flock >/dev/null 2>&1 || exit 0
mkdir -p "$out/stages" 2>/dev/null || exit 0
if [ -L "$lock" ]; then
  echo "$lock is a link, expected the lock of make: remove it"
  exit 0
fi
# A network file system locks alone what is open for writing; others may read the lock of another user.
(umask 0; : >>"$lock") 2>/dev/null || true
if (: 9<>"$lock") 2>/dev/null; then exec 9<>"$lock"
elif (: 9<"$lock") 2>/dev/null; then exec 9<"$lock"
else exit 0; fi

# make_was_started_by PROCESS
make_was_started_by() {
  process=$make
  while [ "${process:-0}" -gt 1 ]; do
    [ "$process" != "$1" ] || return 0
    process=$(sed -n 's/^PPid:[[:blank:]]*//p' "/proc/$process/status" 2>/dev/null)
  done
  return 1
}
# One that has ended and that nobody asked for its exit code (Z) counts as ended.
make_lives() {
  [ -d /proc/self ] || { kill -0 "$make" 2>/dev/null; return; }
  [ -r "/proc/$make/status" ] || return 1
  while read -r name state rest; do
    case $name$state in State:[ZX]) return 1 ;; State:*) return 0 ;; esac
  done <"/proc/$make/status" 2>/dev/null
  return 1
}

host=$(uname -n)
# The lock of a make that has ended is free within a fifth of a second. A shard also waits for the make
# that has sent it.
case $how in
  shared) kind=-s wait_s=60 ;;
  *) kind=-x wait_s=2 ;;
esac
if ! flock $kind -n 9; then
  read -r holder on since <"$lock" || true
  if [ "${on:-}" = "$host" ] && make_was_started_by "${holder:-0}"; then exit 0; fi
  if ! flock $kind -w $wait_s 9; then
    read -r holder on since <"$lock" || true
    echo "another make works in $out: process ${holder:-?} on ${on:-?}, since ${since:-?}: wait for it, end it, or name another folder: make OUT=..."
    exit 0
  fi
fi
printf '%-99s\n' "$make $host $(date '+%Y-%m-%d %H:%M:%S')" 2>/dev/null >&9 || true
(
  trap '' HUP INT TERM
  while make_lives; do sleep 0.2; done
) >/dev/null 2>&1 </dev/null &
