# [output] frames = false: the same run without the frames between start and end, for all but paths.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
expect 0 run_dda -o whole.h5
expect 0 run_dda -o ends.h5 --set output.frames=false
[ "$(wc -c <ends.h5)" -lt "$(wc -c <whole.h5)" ] || fail 'it is no smaller'
for run in whole ends; do
  expect 0 talus-maps $run.h5 --trn slope.tif -o $run --min-passages 2 --no-db
  expect 0 talus-runout $run.h5 --trn slope.tif -o $run.gpkg --json $run.json --tables $run.tables --no-db
  expect 0 talus-fence site.toml $run.h5 --trn slope.tif -o $run.fence.gpkg --csv $run.fence --no-db
done
for file in whole/*.tif whole/*.qml; do
  cmp "$file" "ends/${file#whole/}" || fail "$file of a run without frames is another one"
done
cmp whole.tables/runout.csv ends.tables/runout.csv && cmp whole.tables/runs.csv ends.tables/runs.csv && cmp whole.fence ends.fence || fail 'run-out or fence of a run without frames is another one'
python3 - <<'PY' || fail 'runout.json of a run without frames is another one'
import json
a, b = json.load(open('whole.json')), json.load(open('ends.json'))
for j in (a, b):
    j.pop('doubts', None), j.pop('n_doubts', None)
assert a == b, [k for k in a if a[k] != b.get(k)]
PY
expect 1 talus-maps whole.h5 ends.h5 --trn slope.tif -o both --no-db
says 'is the same run as'

# blocks that break: their pieces, as a run with frames has them, and in a part of each
breaking='--set fragmentation.enabled=true --set fragmentation.energy_j_m2=1e4'
expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db $breaking -o pieces.h5
expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db $breaking -o pieces_ends.h5 --set output.frames=false
prints 'breaks into two'
for run in pieces pieces_ends; do
  expect 0 talus-reduce $run.h5 --trn slope.tif -o ${run}_part.h5
  for from in $run ${run}_part; do
    expect 0 talus-maps $from.h5 --trn slope.tif -o maps_$from --min-passages 2 --no-db
    expect 0 talus-runout $from.h5 --trn slope.tif -o $from.gpkg --tables $from.tables --no-db
  done
done
[ "$(wc -l <pieces.tables/runout.csv)" -gt 4 ] || fail 'run-out has no pieces'
for other in pieces_ends pieces_part pieces_ends_part; do
  cmp pieces.tables/runout.csv $other.tables/runout.csv && cmp pieces.tables/runs.csv $other.tables/runs.csv || fail "run-out of pieces of $other.h5 is another one"
  for file in maps_pieces/*.tif; do cmp "$file" "maps_$other/${file#maps_pieces/}" || fail "$file of $other.h5 is another one"; done
done
