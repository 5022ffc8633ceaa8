# A run that failed its health is evaluated without being asked for, and everything says so.
mkdir failed
run-probe . 3
run-probe failed 1 status=failed seed=7
expect 0 talus-runout run_0.h5 run_1.h5 failed/run_0.h5 --trn slope.tif -o r.gpkg --json r.json --thickness t.tif
says '1 of 3 runs failed its numerical checks: failed/run_0 (a limit was broken; ended at 5 of 8 s)'
python3 - <<'PY' || fail 'runout.json does not name the run'
import json
j = json.load(open('r.json'))
assert j['failed_runs'] == [{'run': 'failed/run_0', 'run_id': 'probe107000', 'seed': 0,
                             'reason': 'a limit was broken; ended at 5 of 8 s'}], j['failed_runs']
assert j['tags']['N_FAILED'] == '1'
assert j['tags']['REMARK'] == '1 of 3 runs failed its numerical checks'
PY
gdalinfo t.tif | grep -q 'HEALTH=1 of 3 runs failed its numerical checks: failed/run_0' || fail 'the map is not marked'
for layer in deposit runs streamline; do
  ogrinfo -so r.gpkg "$layer" | grep -q 'DESCRIPTION=.*(1 of 3 runs failed its numerical checks)' || fail "layer $layer is not marked"
done
[ "$(ogrinfo -q r.gpkg -sql "SELECT * FROM runs WHERE status = 'failed'" | grep -c 'run_id (String) = probe107000')" = 1 ] || fail 'the run is not marked in the table'
# where all is well nothing is said
expect 0 talus-runout run_0.h5 run_1.h5 --trn slope.tif -o s.gpkg --json s.json
grep -q 'failed' err && fail 'a failure where there is none'
grep -q '"failed_runs": \[\]' s.json || fail 'no empty list of failed runs'
