#!/bin/sh
# run_ended.sh NAME MARK FILE TOTAL BEGUN [must]: a run has ended; says how far the runs of this make
# are, at most a hundred times. MARK is left where the run failed, FILE keeps a line a run, TOTAL runs
# were lacking at BEGUN (s since 1970). With `must` the exit code is 1 where the run failed.
set -eu
name=$1 mark=$2 file=$3 total=$4 begun=$5 must=${6:-}
outcome=done
if [ -f "$mark" ]; then
  outcome=failed
  if grep -q 'did not end by itself' "$mark"; then
    printf '%s: %s\n' "$name" "$(cut -f2 "$mark")" >&2
  fi
fi
echo $outcome >>"$file"
n=$(wc -l <"$file")
n_failed=$(grep -c failed "$file" || true)
if [ "$n" -ge "$total" ]; then
  rm -f "$file"
  left=
else
  left_s=$((($(date +%s) - begun) * (total - n) / n))
  if [ $left_s -lt 120 ]; then left=", about $left_s s left"
  elif [ $left_s -lt 7200 ]; then left=", about $((left_s / 60)) min left"
  else left=", about $((left_s / 3600)) h left"; fi
fi
[ $((100 * n / total)) -eq $((100 * (n - 1) / total)) ] ||
  echo "runs: $((n - n_failed)) done, $n_failed failed, $((n < total ? total - n : 0)) to go$left"
[ -z "$must" ] || [ $outcome = done ]
