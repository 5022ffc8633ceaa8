#!/bin/sh
# Every source is as clang-format 14 leaves it; the pipelines stay within 100 columns.
cd "$1" || exit 1
command -v clang-format-14 >/dev/null 2>&1 || { echo "skipped: clang-format-14 is not installed"; exit 77; }
git ls-files -z 'pipelines/*' | xargs -0 awk '
  length > 100 { print FILENAME ":" FNR ": longer than 100 columns"; wide = 1 }
  END { exit wide }' || exit 1
git ls-files -z 'libcore/*.[ch]pp' 'verify/*.[ch]pp' 'tools/*.[ch]pp' 'tests/*.[ch]pp' |
  xargs -0 -r clang-format-14 --dry-run -Werror
