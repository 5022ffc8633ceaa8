# Runs in any order give the same bytes; the spread over runs is beside each run.
run-probe . 5 blocks=2
expect 0 talus-runout run_0.h5 run_1.h5 run_2.h5 run_3.h5 run_4.h5 --trn slope.tif -o a.gpkg --json a.json --tables a
prints 'run-out of 5 runs: H '
prints 'm along the path, angle of reach '
expect 0 talus-runout run_4.h5 run_2.h5 run_0.h5 run_3.h5 run_1.h5 --trn slope.tif -o b.gpkg --json b.json --tables b
for file in a.gpkg a.json a/runout.csv a/runout.svg a/runs.csv a/curves.csv; do
  cmp "$file" "b${file#a}" || fail "$file depends on the order of the runs"
done
grep -q '"n": 5' a.json || fail 'no spread over the five runs'
expect 0 talus-runout run_0.h5 --trn slope.tif -o c.gpkg --json
prints '"spread_over_runs"'
expect 1 talus-runout run_0.h5 --trn slope.tif -o a.gpkg
says 'exists already'
