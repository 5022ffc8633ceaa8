# Time, memory and disk of parts and of what is made from them: THOUSANDS times 1,000 runs of one box
# that slides down a plane (run-probe). Needs the release build.
#   bash tests/bench/parts_of_runs.sh [THOUSANDS]
set -euo pipefail
thousands=${1:-10}
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
for k in $(seq "$thousands"); do
  mkdir "runs_$k"
  run-probe "runs_$k" 1000 frames=1 seed="$k"
  [ "$k" = 1 ] && cp runs_1/slope.tif . && echo "1,000 run files: $(du -sk runs_1 | cut -f1) kB"
  ls "runs_$k"/run_*.h5 >list
  measured "reduction of thousand $k" talus-reduce --runs-from list --trn slope.tif -o "part_$k.h5"
  rm -r "runs_$k"
done
measured "$thousands parts to one" talus-reduce part_*.h5 --trn slope.tif -o all.h5
echo "the part of all: $(stat -c %s all.h5) bytes"
measured "maps of $thousands parts" talus-maps part_*.h5 --trn slope.tif -o maps
measured "maps of the part of all" talus-maps all.h5 --trn slope.tif -o maps_of_all
measured "run-out" talus-runout all.h5 --trn slope.tif -o runout.gpkg
for file in maps/*.tif; do cmp "$file" "maps_of_all/${file#maps/}"; done
