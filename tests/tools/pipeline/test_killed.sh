# make that is killed at any moment leaves nothing half-made: the next one continues to the same
# bytes.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v setsid >/dev/null || skip "needs setsid"
site whole
made whole
site killed
for pause in 0.05 0.3 0.7 1.2 2; do
  setsid make -C killed BIN= -j2 >log 2>&1 &
  group=$!
  sleep $pause
  kill -9 -$group 2>/dev/null || break
  wait $group 2>/dev/null || true
done
made killed -j2
same whole killed

# a make that is asked to end passes it on: its run writes a checkpoint, and the next make
# continues. A run that has not come to its first step has nothing to keep: on a busy machine it
# gets longer.
site asked
for pause in 1 4 16 64; do
  make -C asked BIN= WITHOUT=no runs DDA_FLAGS='--set solver.time_step_s=0.00002' >log 2>&1 &
  process=$!
  n=0
  until grep -q '^batch: runs' log; do
    n=$((n + 1))
    [ $n -lt 600 ] || fail "make does not come to its run"
    sleep 0.05
  done
  sleep $pause
  kill -TERM $process || fail "the run was over before make was asked to end"
  if wait $process; then fail "make that was asked to end says that all is well"; fi
  n=0
  until [ -s asked/out/runs/run_1.h5.part ] || [ $n -eq 100 ]; do
    n=$((n + 1))
    sleep 0.05
  done
  [ ! -s asked/out/runs/run_1.h5.part ] || break
done
[ -s asked/out/runs/run_1.h5.part ] || fail "no checkpoint of the run"
