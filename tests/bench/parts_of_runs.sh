# Time, memory and disk of parts and of what is made from them: PARTS parts, each of RUNS runs of one box
# that slides down a plane (run-probe). Needs the release build.
#   bash tests/bench/parts_of_runs.sh [PARTS [RUNS]]
set -euo pipefail
n_parts=${1:-10} n_runs=${2:-1000}
root=$(cd "$(dirname "$0")/../.." && pwd)
PATH=$root/build/release/tools:$root/build/release/tests:$PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# measured WHAT COMMAND...
measured() {
  local what=$1
  shift
  /usr/bin/time -f "$what: %U + %S s of CPU time, %M kB" "$@" --no-db -q
}
for k in $(seq "$n_parts"); do
  mkdir "runs_$k"
  run-probe "runs_$k" "$n_runs" frames=1 seed="$k"
  [ "$k" = 1 ] && cp runs_1/slope.tif . && echo "$n_runs run files: $(cat runs_1/run_*.h5 | wc -c) bytes" &&
    measured "maps of $n_runs run files" talus-maps runs_1 --trn slope.tif -o maps_of_runs
  measured "reduction $k" talus-reduce "runs_$k" --trn slope.tif -o "part_$k.h5"
  rm -r "runs_$k"
done
measured "$n_parts parts to one" talus-reduce part_*.h5 --trn slope.tif -o all.h5
echo "the part of all: $(stat -c %s all.h5) bytes"
measured "maps of $n_parts parts" talus-maps part_*.h5 --trn slope.tif -o maps
measured "maps of the part of all" talus-maps all.h5 --trn slope.tif -o maps_of_all
measured "run-out" talus-runout all.h5 --trn slope.tif -o runout.gpkg
for file in maps/*.tif; do cmp "$file" "maps_of_all/${file#maps/}"; done
