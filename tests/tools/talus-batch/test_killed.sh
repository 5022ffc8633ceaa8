# Kills at random moments, of the batch, of a run, of all: nothing is lost, and the next batch
# continues to the bytes of one that was left alone. TALUS_SEED=n repeats the choices,
# TALUS_KILLS=200 does more of them.
. "$source_dir/tests/tools/talus-batch/common.sh"
for program in setsid pgrep; do command -v $program >/dev/null || skip "needs $program"; done
seed=${TALUS_SEED:-$(date +%s)}
echo "TALUS_SEED=$seed"
state=$((seed % 2147483648))
# drawn BELOW: sets `drawn` to a number from 0 to BELOW - 1
drawn() {
  state=$(((state * 1103515245 + 12345) % 2147483648))
  drawn=$((state / 65536 % $1))
}
set -- --runs 6 --jobs 3
cp -r results whole
begun=$(date +%s%3N)
expect 0 talus-batch site.toml --results whole --no-db "$@"
whole_ms=$(($(date +%s%3N) - begun))
n_killed=0
for _ in $(seq "${TALUS_KILLS:-12}"); do
  setsid talus-batch site.toml --results results --no-db "$@" >log 2>&1 &
  group=$!
  drawn $whole_ms
  sleep "$(printf '%d.%03d' $((drawn / 1000)) $((drawn % 1000)))"
  drawn 4
  case $drawn in
    0) victims=-$group signal=KILL ;;
    1) victims=$group signal=KILL ;;
    2) victims=$group signal=TERM ;;
    3) victims=$(pgrep -P $group | head -n 1) signal=KILL ;;
  esac
  [ -z "$victims" ] || { kill -s $signal -- $victims 2>/dev/null && n_killed=$((n_killed + 1)); } || true
  wait $group 2>/dev/null || true
  # existing files are whole, and readable by everyone
  for run in results/runs/run_*.h5; do
    [ ! -e "$run" ] || cmp "$run" "whole/${run#results/}" || fail "$run is another run"
  done
  [ ! -e results/runs/run_1.h5 ] || expect 0 talus-places --version
  drawn 3
  [ $drawn -ne 0 ] || rm -f results/runs/run_$((drawn + 1)).h5 results/runs/ensemble.json
done
[ $n_killed -ge 1 ] || fail "nothing was killed"
expect 0 batch "$@"
rm -f results/runs/.lock whole/runs/.lock results/runs/.*.part* results/runs/*.part
diff -r results/runs whole/runs || fail "a batch that was killed $n_killed times made something else"
echo "$n_killed kills"

# a run resumes where it was
rm results/runs/run_1.h5
talus-batch site.toml --results results --no-db --runs 1 -- --set solver.time_step_s=0.0000001 2>log &
process=$!
n=0
until [ -s results/runs/run_1.h5.part ] || [ $n -eq 100 ]; do
  n=$((n + 1))
  [ $n -ne 30 ] || kill -TERM $process
  sleep 0.1
done
code=0
wait $process || code=$?
[ $code -eq 130 ] || fail "an interrupted batch ends with $code: $(cat log)"
[ -s results/runs/run_1.h5.part ] || fail "no checkpoint"
talus-batch site.toml --results results --no-db --runs 1 -- --set solver.time_step_s=0.0000001 >log 2>&1 &
process=$!
n=0
until grep -q 'run_1: goes on at' log || [ $n -eq 100 ]; do
  n=$((n + 1))
  sleep 0.1
done
# one at a time works in a folder
timeout 30 talus-batch site.toml --results results --no-db --runs 1 2>second && fail "two batches worked in one folder"
grep -q "is in use: its runs are made by process $process on" second || fail "$(cat second)"
kill -TERM $process
wait $process || true
grep -q 'run_1: goes on at' log || fail "the run began anew: $(cat log)"
