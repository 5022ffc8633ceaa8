#!/bin/sh
# made.sh TOOL FILE BEFORE: TOOL has said that all went well. Does FILE exist, and is it another one
# than BEFORE (its inode and time when TOOL was started, empty where it did not exist)? The starter
# of a tool (srun, a container) may lose it and yet end without an error.
set -eu
tool=$1 file=$2 before=$3
for _ in 1 2 3; do
  ls "${file%/*}" >/dev/null 2>&1 || true  # asks a network file system again
  if [ -s "$file" ] && [ "$(stat -c '%i %Z' "$file")" != "$before" ]; then exit 0; fi
  sleep 1
done
echo "make: $tool ended without an error and yet did not write $file: what starts it (BIN) lost \
it; make again" >&2
exit 1
