# One make at a time works on one folder of results; the lock goes with the make, however that ends.
. "$source_dir/tests/tools/pipeline/common.sh"
for program in flock setsid pgrep; do command -v $program >/dev/null || skip "needs $program"; done
site slope
made slope RUNS=2 prepare
mkdir beside
cp slope/site.toml slope/contours.gpkg slope/Makefile beside
ln -s ../slope/out beside/out
long='--set solver.time_step_s=0.00001'

# begin ARGUMENTS: a make that runs for long, as $process, whose run (not the query of its plan)
# has begun, as $run_of_make
begin() {
  setsid make -C slope BIN= WITHOUT=no RUNS=2 "$@" >log 2>&1 &
  process=$!
  n=0
  until run_of_make=$(pgrep -f -P "$(pgrep -d, -g "$process" talus-batch || echo 0)" -- "talus-dda .* --label "); do
    n=$((n + 1))
    [ $n -lt 600 ] || { cat log >&2; fail "make does not come to its run"; }
    sleep 0.1
  done
}
# finished: ends the begun make, with its runs
finished() {
  kill -TERM "$process" 2>/dev/null || true
  wait "$process" 2>/dev/null || true
}
refused() {
  expect 2 make -C "$@"
  says "another make works in out: process $process on $(uname -n), since "
}

begin DDA_FLAGS="$long" runs
refused slope BIN= RUNS=2 runs
refused beside BIN= RUNS=2 runs
refused slope BIN= RUNS=auto
refused slope clean
expect 0 make -C slope BIN= -n RUNS=2 runs
expect 0 make -C slope BIN= OUT=other terrain
expect 0 make -C slope help
finished
made slope terrain

# killed without a chance to tidy up
begin DDA_FLAGS="$long" runs
kill -9 "$process"
wait "$process" 2>/dev/null || true
made slope terrain
n=0
while kill -0 $run_of_make 2>/dev/null; do
  n=$((n + 1))
  [ $n -lt 300 ] || fail "a run of a make that was killed goes on"
  sleep 0.1
done

# Shards share the folder with one another alone.
begin DDA_FLAGS="$long" SHARD=1 SHARDS=2 runs-shard
expect 2 make -C slope BIN= RUNS=2 runs
says "another make works in out"
expect 0 make -C slope BIN= WITHOUT=no RUNS=2 SHARD=2 SHARDS=2 DDA_FLAGS='--set solver.duration_s=0.1' runs-shard
finished

# A lock that is a link would lead elsewhere.
rm slope/out/stages/.lock
echo mine >letter
ln -s "$PWD/letter" slope/out/stages/.lock
expect 2 make -C slope BIN= terrain
says ".lock is a link"
[ "$(cat letter)" = mine ] || fail "a file of the user was overwritten"
rm slope/out/stages/.lock
made slope terrain
