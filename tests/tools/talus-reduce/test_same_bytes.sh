# Runs and parts of them, in any order and any mixture, give the same part and the same results.
run-probe . 12 blocks=3
reduce() { expect 0 talus-reduce "$@" --trn slope.tif; }

reduce run_*.h5 -o whole.h5
reduce run_7.h5 run_2.h5 run_11.h5 run_0.h5 run_1.h5 run_3.h5 run_4.h5 run_5.h5 run_6.h5 run_8.h5 run_9.h5 run_10.h5 -o mixed.h5
cmp whole.h5 mixed.h5 || fail 'the part depends on the order of the runs'
reduce run_0.h5 -o one.h5
reduce run_1.h5 run_2.h5 run_3.h5 run_4.h5 run_5.h5 run_6.h5 run_7.h5 run_8.h5 run_9.h5 run_10.h5 run_11.h5 -o eleven.h5
reduce run_0.h5 run_2.h5 run_4.h5 run_6.h5 run_8.h5 run_10.h5 -o even.h5
reduce run_1.h5 run_3.h5 run_5.h5 run_7.h5 run_9.h5 run_11.h5 -o odd.h5
for k in 0 3 6 9; do reduce run_$k.h5 run_$((k + 1)).h5 run_$((k + 2)).h5 -o "third_$k.h5"; done
n=0
for set in 'eleven.h5 one.h5' 'one.h5 eleven.h5' 'odd.h5 even.h5' 'third_6.h5 third_0.h5 third_9.h5 third_3.h5' \
  'run_5.h5 third_6.h5 run_3.h5 third_0.h5 run_4.h5 third_9.h5' whole.h5; do
  n=$((n + 1))
  reduce $set -o "again_$n.h5"
  cmp whole.h5 "again_$n.h5" || fail "the part of $set is another one"
done

# the same maps of any mixture, byte for byte
expect 0 talus-maps run_*.h5 --trn slope.tif -o maps --min-passages 2 --pages png
expect 0 talus-maps run_*.h5 --trn slope.tif -o coarse --cell-size-m 6 --memory-mb 0.005
for set in whole.h5 'eleven.h5 one.h5' 'odd.h5 even.h5' 'third_6.h5 third_0.h5 third_9.h5 third_3.h5' \
  'run_5.h5 third_6.h5 run_3.h5 third_0.h5 run_4.h5 third_9.h5'; do
  expect 0 talus-maps $set --trn slope.tif -o of_parts --min-passages 2 --pages png --overwrite
  for file in maps/*.tif maps/*.qml maps/*.png; do cmp "$file" "of_parts/${file#maps/}" || fail "$file of $set is another one"; done
  expect 0 talus-maps $set --trn slope.tif -o of_parts_coarse --cell-size-m 6 --memory-mb 0.005 --overwrite
  for file in coarse/*.tif coarse/*.qml; do cmp "$file" "of_parts_coarse/${file#coarse/}" || fail "coarse $file of $set"; done
done

# run-out: all that needs no frames
expect 0 talus-runout run_*.h5 --trn slope.tif -o a.gpkg --json a.json --tables a --thickness a.tif
grep -q 'no frames' err && fail 'runs are said to have no frames'
expect 1 talus-runout odd.h5 third_0.h5 --trn slope.tif -o b.gpkg
says 'is the same run as'
expect 0 talus-runout odd.h5 even.h5 --trn slope.tif -o b.gpkg --json b.json --tables b --thickness b.tif
says '12 of 12 runs have no frames: paths, their points and the curves leave them out'
cmp a/runout.csv b/runout.csv && cmp a/runs.csv b/runs.csv && cmp a.tif b.tif && cmp a/runout.svg b/runout.svg || fail 'run-out of parts is another one'
python3 - <<'PY' || fail 'runout.json of parts is another one'
import json
a, b = json.load(open('a.json')), json.load(open('b.json'))
for j in (a, b):
    j.pop('doubts', None), j.pop('n_doubts', None)
assert a == b, [k for k in a if a[k] != b.get(k)]
PY
for layer in deposit streamline envelope runs reach_points; do
  for side in a b; do ogr2ogr -f CSV "$side.layer.csv" "$side.gpkg" "$layer" -lco GEOMETRY=AS_WKT; done
  cmp a.layer.csv b.layer.csv || fail "layer $layer of parts is another one"
  rm a.layer.csv b.layer.csv
done
[ "$(wc -l <b/curves.csv)" = 1 ] || fail 'curves of runs without frames'

# fences
expect 0 talus-fence site.toml run_*.h5 --trn slope.tif -o fa.gpkg --json fa.json --csv fa.csv
expect 0 talus-fence site.toml even.h5 odd.h5 --trn slope.tif -o fb.gpkg --json fb.json --csv fb.csv
cmp fa.csv fb.csv && cmp fa.json fb.json || fail 'the fence of parts is another one'
