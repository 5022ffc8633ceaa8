# A run in place counts by the settings that it was made with, not by its time.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
runs() { made slope WITHOUT=no "$@" runs; }
# begun_again N: so many runs since the last time
begun_again() {
  n=$(talus-runs --db slope/out/runs.sqlite list | grep -c 'talus-dda ' || true)
  [ $((n - ${before:-0})) -eq "$1" ] || fail "$((n - ${before:-0})) runs were made, expected $1: $2"
  before=$n
}
runs RUNS=2
begun_again 2 "the first ones"

# by a clock that is ahead by less than a minute
touch -d '+40 seconds' slope/out/runs/run_*.h5
runs RUNS=2
begun_again 0 "only the times are others"
touch -d '+40 seconds' slope/out/runs/run_*.h5
sed -i 's/^duration_s = .*/duration_s = 0.4/' slope/site.toml
runs RUNS=2
begun_again 2 "another duration, and runs whose time is of the future"

# A run of other settings in place of the one that make made, newer than all else.
cp slope/out/runs/run_1.h5 old.h5
sed -i 's/^duration_s = .*/duration_s = 0.3/' slope/site.toml
runs RUNS=2
begun_again 2 "another duration"
cp old.h5 slope/out/runs/run_1.h5
runs RUNS=2
begun_again 1 "a run of other settings was put in place"

# Settings that are as they were make no run again, though stages were looked at in between.
sed -i 's/^duration_s = .*/duration_s = 0.4/' slope/site.toml
made slope check
sed -i 's/^duration_s = .*/duration_s = 0.3/' slope/site.toml
runs RUNS=2
begun_again 0 "the settings are those of the runs"
runs RUNS=3
begun_again 1 "a third one"

# options, those of alternatives, and files made before the runs
runs RUNS=2 DDA_FLAGS='--set ground.slope.friction_deg=31'
begun_again 2 "another option"
two='[variant.b]\nweight = 1\n[variant.a]\nweight = 1\nsolver.accuracy'
variants slope "$two = 0.02"
runs RUNS=2
begun_again 4 "alternatives"
variants slope "$two = 0.03"
runs RUNS=2
begun_again 2 "a key of one alternative"
variants slope ""
made slope WITHOUT=no RUNS=1 runs
begun_again 1 "without the option"

# A run that fails its health is not repeated, whoever asked for it.
deep='--set solver.max_penetration_m=1e-9'
expect 2 make -C slope BIN= WITHOUT=no RUNS=1 DDA_FLAGS="$deep" maps
begun_again 1 "a limit that the run breaks"
expect 2 make -C slope BIN= WITHOUT=no RUNS=1 DDA_FLAGS="$deep" runs
says "1 of 1 run failed"
begun_again 0 "a run that failed"

touch -d '+40 seconds' slope/out/runs/run_1.h5
made slope WITHOUT=no RUNS=1 BLOCKS_FLAGS='--set source.depth_m=7' runs
begun_again 1 "other blocks, and a run whose time is of the future"

made slope clean
[ ! -e slope/out ] || fail "left in out: $(find slope/out)"
