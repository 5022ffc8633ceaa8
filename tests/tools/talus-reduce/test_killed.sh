# A reduction that is killed at any time leaves no part; said again, it makes the same one.
run-probe . 40 blocks=6
expect 0 talus-reduce run_*.h5 --trn slope.tif -o whole.h5
for after in 0.01 0.05 0.1 0.2 0.4 0.8; do
  talus-reduce run_*.h5 --trn slope.tif -o part.h5 --overwrite 2>/dev/null >/dev/null &
  job=$!
  sleep $after
  kill -9 $job 2>/dev/null || true
  wait $job 2>/dev/null || true
  [ ! -e part.h5 ] || cmp part.h5 whole.h5 || fail "killed after $after s, it left another part"
done
expect 0 talus-reduce run_*.h5 --trn slope.tif -o part.h5 --overwrite
cmp part.h5 whole.h5 || fail 'another part after kills'
