# Boxes that friction holds have moved nowhere: their extent is not a run-out, and the tool says so.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
sed -e 's/^height_above_ground_m.*//' -e 's/^spin_rad_s.*//' -e 's/^velocity_m_s.*//' site.toml >flat.toml
mv flat.toml site.toml
make_blocks
for friction in 80 10; do
  expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o "run_$friction.h5" --no-db \
    --set solver.duration_s=2 --set "$(grep -o 'ground\.[a-z]*' site.toml | head -1).friction_deg=$friction"
done
expect 0 talus-runout run_80.h5 --trn slope.tif -o held.gpkg --no-db
says '1 of 1 run did not move (no block by more than 1 m): no run-out'
prints 'no run-out: no H, L and angle of reach'
expect 0 talus-runout run_10.h5 --trn slope.tif -o gone.gpkg --no-db
grep -q 'did not move' err && fail 'boxes that slid are said to stand'
expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o again.h5 --no-db \
  --set solver.duration_s=2 --set "$(grep -o 'ground\.[a-z]*' site.toml | head -1).friction_deg=80"
says 'no block moved more than 1 m: there is no run-out'
prints '0 % of the mass moved more than 1 m, 0 % more than 20 m; displacement by mass: p50 0'

# Of three runs the first moves nothing: it is counted, and left out of reach and means.
mkdir runs part
run-probe runs 3 still_runs=1
expect 0 talus-runout runs/run_*.h5 --trn runs/slope.tif -o three.gpkg --json three.json --tables . --no-db
says '1 of 3 runs did not move'
prints '1 of 3 runs did not move (no block by more than 1 m)'
prints 'run-out of 2 runs that moved: H '
prints 'volume of all 3 runs: released '
prints 'moved, all runs together: 66.7 % of the mass moved more than 1 m, 66.7 % more than 20 m'
python3 - <<'PY' || fail 'a run that did not move counts'
import csv, json
j = json.load(open('three.json'))
assert j['n_runs'] == 3 and j['n_runs_moved'] == 2
still = next(r for r in j['runs'] if r['run_id'] == 'probe100000')
assert not still['did_move'] and still['toe_block'] is None and still['toe_fate'] is None
assert all(v is None for v in still['event'].values()), still['event']
assert still['centre_of_mass']['H_over_L'] is None
moved = [r for r in j['runs'] if r['did_move']]
for key in 'H_m', 'L_path_m', 'L_chord_m', 'reach_angle_path_deg':
    s = j['spread_over_runs'][key]
    mean = sum(r['event'][key] for r in moved) / 2
    assert s['n'] == 2 and abs(s['mean'] - mean) < 1e-9, (key, s, mean)
assert len(j['mobility'][0]['runs']) == 2
rows = list(csv.DictReader(open('runs.csv')))
assert [r['moved'] for r in rows] == ['0', '1', '1'] and rows[0]['L_path_m'] == ''
assert abs(float(rows[1]['L_path_m']) - moved[0]['event']['L_path_m']) < 1e-6
PY
ogrinfo -q three.gpkg -sql 'SELECT count(*) AS n FROM runs WHERE L_path_m IS NULL AND moved = 0' | grep -q 'n (Integer) = 1' || fail 'layer runs'
[ "$(ogrinfo -q three.gpkg -sql 'SELECT run_id FROM streamline' | grep -c 'String')" = 2 ] || fail 'a streamline of a run that stayed'

# One of three equal boxes slides 36 m: a third of the mass moved.
run-probe part 1 blocks=3 still=2
expect 0 talus-runout part/run_0.h5 --trn part/slope.tif -o third.gpkg --json third.json --no-db
says 'only 33.3 % of the mass moved more than 1 m'
prints 'moved: 33.3 % of the mass moved more than 1 m, 33.3 % more than 20 m; displacement by mass: p50 0 m, p90 36 m, p95 36 m'
python3 - <<'PY' || fail 'what moved is wrong'
import json
m = json.load(open('third.json'))['runs'][0]['moved']
assert abs(m['share_moved_1_m'] - 1 / 3) < 1e-12 and m['displacement_p50_m'] == 0
assert abs(m['displacement_p90_m'] - 36) < 1e-6 and abs(m['released_t'] - 7.8) < 1e-12
PY

# A block that still moves is not left out of L, and it is said.
mkdir moving
run-probe moving 1 moving=1
expect 0 talus-runout moving/run_0.h5 --trn moving/slope.tif -o moving.gpkg --json moving.json --no-db
prints 'the farthest block still moving'
grep -q '"toe_fate": "moving"' moving.json || fail 'nothing says that the farthest block moves'
