#!/bin/sh
# auto_runs.sh MAKE OUT MOST GOAL...: makes 50, 100, 200 ... runs, MOST at the most, until all places of
# the site are known as surely as [place.*] half_width wants, then the goals with these runs. The width
# alone decides, never what was found.
set -eu
make=$1 out=$2 most=$3
shift 3
# with -n and -q nothing is known of the runs
flags=${MAKEFLAGS-}
case ${flags%% *} in
  -* | *=*) ;;
  *[nq]*) exec $make RUNS=50 "$@" ;;
esac
n=50
while :; do
  [ "$n" -lt "$most" ] || n=$most
  $make RUNS="$n" places
  [ -f "$out/places.json" ] || {
    echo "RUNS=auto needs a place: add [place.NAME] with a polygon or a fence to site.toml" >&2
    exit 1
  }
  lacking=$(sed -n 's/^ *"runs_to_add": \([0-9]*\),*$/\1/p' "$out/places.json" | head -n 1)
  if [ "$lacking" -eq 0 ] && grep -q '"half_width": null' "$out/places.json"; then
    echo "RUNS=auto: more runs give no interval: raise rock_masses to 10 or more" >&2
    exit 1
  fi
  if [ "$lacking" -eq 0 ]; then
    echo "RUNS=auto: $n runs do"
    break
  fi
  if [ "$n" -ge "$most" ]; then
    echo "RUNS=auto: $n runs do not do, $lacking more would be needed: RUNS_MOST=$((n + lacking)) allows them"
    break
  fi
  n=$((2 * n))
done
exec $make RUNS="$n" "$@"
