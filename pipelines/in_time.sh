#!/bin/sh
# in_time.sh OUT: gives results whose time is in the future (a clock that was set back, another
# machine) times just before now, in the order that they had, so that files that make writes from
# now on are newer than all of them. The clock is that of OUT's file system.
set -eu
export LC_ALL=C
now=$1/stages/.now
touch "$now"
find "$1/" -type f -newer "$now" -printf '%T@\t%p\n' | sort -n | cut -f2- |
  awk -v now="$(stat -c %.9Y "$now")" '
    { name[NR] = $0 }
    END { for (i = 1; i <= NR; ++i) printf "-d@%.6f\n%s\n", now - (NR - i + 1) * 1e-6, name[i] }' |
  xargs -r -d '\n' -n 2 touch -c
rm -f "$now"
