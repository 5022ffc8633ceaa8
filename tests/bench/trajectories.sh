#!/bin/bash
# Complete single-block trajectories a CPU second: rocks of 0.3 m3 released over the source of
# gschnitz_gar, each as if alone, until they rest or leave the terrain; with all outputs written,
# without passages, and with everything that the plan would leave out.
# bash tests/bench/trajectories.sh [FOLDER OF THE EXECUTABLES], data in ../shared/data
. "$(dirname "$0")/common.sh"
cat >site.toml <<END
[site]
name = "gschnitz_gar"
crs = "EPSG:31287"
[ground.slope]
friction_deg = 32
cor = 0.35
[rockfall.rock]
polygon_file = "$data/scenarios/gschnitz_gar.gpkg|layername=release"
shape = "rock"
size_m = [1.2, 1.0, 0.8]
release_spacing_m = 5
height_above_ground_m = 0.5
[solver]
duration_s = 120
max_lost_share = 1
[output]
frame_interval_s = 10
END
"$bin/talus-blocks" site.toml --trn trn.tif -o blocks.h5 --no-db -q

# run NAME OPTIONS...: the middle of three runs by CPU time
run() {
  name=$1
  shift
  for _ in 1 2 3; do
    "$bin/talus-dda" site.toml --trn trn.tif --blocks blocks.h5 -o run.h5 --overwrite --no-db -q \
      --json "$@" 2>/dev/null |
      awk -v name="$name" -F '[:,]' '
        /"n_blocks"/ { n = $2 } /"cpu_time_s"/ { cpu = $2 } /"block_steps"/ { steps = $2 }
        /"left_domain"/ { left = $2 } /"impacts"/ { impacts = $2 } /"n_passages"/ { passages = $2 }
        END { printf "%-28s %.3f CPU s, %4.0f trajectories a CPU second (%d; %d left the terrain), %d block steps, %d impacts, %d passages\n",
                     name, cpu, n / cpu, n, left, steps, impacts, passages }'
  done | sort | sed -n 2p
}
run "all outputs"
run "without passages" --set output.passages=false
run "full plan" --plan=full
