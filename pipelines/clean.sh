#!/bin/sh
# clean.sh OUT MARK PATTERNS FOLDERS: removes from OUT what the pipeline made: files by PATTERNS (one
# argument, parted by blanks), then MARK, then FOLDERS and OUT where nothing is left in them. Without
# MARK nothing in OUT is the pipeline's, and nothing goes. Says what stays.
set -eu
out=$1 mark=$2 patterns=$3 folders=$4
[ -d "$out" ] || exit 0
if ! grep -q '^# written by talus-site' "$out/$mark" 2>/dev/null; then
  echo "clean: $out holds nothing that the pipeline made: all of it stays"
  exit 0
fi
for pattern in $patterns "$mark"; do
  for file in "$out"/$pattern; do
    [ -d "$file" ] || rm -f -- "$file"
  done
done
for pattern in $folders; do
  for folder in "$out"/$pattern; do
    [ -d "$folder" ] && rmdir -- "$folder" 2>/dev/null || true
  done
done
rmdir -- "$out" 2>/dev/null && exit 0
echo "clean: not made by the pipeline, so left in $out:" $(cd "$out" && ls -A)
