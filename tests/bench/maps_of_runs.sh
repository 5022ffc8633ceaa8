#!/bin/bash
# All maps of 1,000 runs of one rock each on gschnitz_gar beside the simulation of these runs, in CPU
# seconds (maps: the middle of three). Rocks of 0.3 m3 start at points drawn in the release polygon.
# bash tests/bench/maps_of_runs.sh [FOLDER OF THE EXECUTABLES [RUNS]], data in ../shared/data
. "$(dirname "$0")/common.sh"
n=${2:-1000}
TIMEFORMAT='%U %S'

# place SEED: a point of the release polygon, between its four corners
place() {
  awk -v seed="$1" 'BEGIN {
    srand(seed); u = rand(); v = rand()
    x = (1 - u) * ((1 - v) * 248400 + v * 248440) + u * ((1 - v) * 248440 + v * 248480)
    y = (1 - u) * ((1 - v) * 351665 + v * 351590) + u * ((1 - v) * 351672 + v * 351612)
    printf "[%.2f, %.2f]", x, y }'
}
for seed in $(seq "$n"); do
  cat >"site_$seed.toml" <<END
[site]
name = "gschnitz_gar"
crs = "EPSG:31287"
[ground.slope]
friction_deg = 32
cor = 0.35
[blocks.rock]
shape = "rock"
size_m = [1.2, 1.0, 0.8]
position_m = [$(place "$seed")]
height_above_ground_m = 0.5
random_orientation = true
seed = $seed
[solver]
duration_s = 60
max_lost_share = 1
END
done
blocks() { for seed in $(seq "$n"); do "$bin/talus-blocks" "site_$seed.toml" --trn trn.tif -o "blocks_$seed.h5" --no-db -q; done; }
runs() {
  for seed in $(seq "$n"); do
    "$bin/talus-dda" "site_$seed.toml" --trn trn.tif --blocks "blocks_$seed.h5" -o "run_$seed.h5" --seed "$seed" --no-db -q 2>/dev/null
  done
}
maps() { "$bin/talus-maps" run_*.h5 --trn trn.tif -o maps --overwrite --no-db -q 2>/dev/null; }
seconds() { awk '{ print $1 + $2 }'; }
blocks
simulated=$({ time runs >&2; } 2>&1 | seconds)
mapped=$(for _ in 1 2 3; do { time maps >&2; } 2>&1 | seconds; done | sort -g | sed -n 2p)
awk -v n="$n" -v s="$simulated" -v m="$mapped" 'BEGIN {
  printf "%d runs simulated in %.1f CPU s, all maps of them in %.2f CPU s: %.2f %%\n", n, s, m, 100 * m / s }'
