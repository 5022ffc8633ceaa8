# A box slides 36 m down 30 degrees: H = 18 m, L = 31.177 m, both angles 30 degrees, to the digit.
run-probe . 1
expect 0 talus-runout run_0.h5 --trn slope.tif -o runout.gpkg --json runout.json --tables . --thickness thickness.tif --friction-deg 20
prints 'run-out of run probe100000'
nothing_left
grep -q '^probe100000,0,deposited,1,2600,176.249147,18,31.17691454,31.17691454,30,30,12,187.2,36$' runout.csv || fail "runout.csv holds $(tail -1 runout.csv)"
python3 - <<'PY' || fail 'runout.json differs from the closed form'
import json, math
j = json.load(open('runout.json'))
b = j['balance']
assert b['released_m3'] == b['deposited_m3'] + b['moving_m3'] + b['left_domain_m3'] == 1
run = j['runs'][0]
centre = run['centre_of_mass']
assert abs(centre['H_over_L'] - math.tan(math.pi / 6)) < 1e-7
assert abs(centre['atan_sum_mH_over_sum_mL_deg'] - 30) < 1e-6
assert abs(centre['tan_friction'] - math.tan(math.radians(20))) < 1e-12
# top: the box's upper edge at the start; toe: the ground below its front at the end
start, end = 11 - 0.5, 11 + 36 * math.cos(math.pi / 6) + 0.5
assert abs(run['event']['H_m'] - ((end - 11) * math.tan(math.pi / 6) + 0.6 + 0.5)) < 1e-6, run['event']
assert run['angle_monotone_along_path'] and run['toe_fate'] == 'deposited'
assert j['swept_area_m2'] == 34 * 4
assert abs(run['energy_shares']['friction'] - 1) < 1e-12
assert len(j['mobility']) == 17
assert sum(m['from_memory'] for m in j['mobility']) == 6
PY
grep -q 'rockfalls (Corominas 1996)' runout.svg || fail 'the chart has no legend'
ogrinfo -so runout.gpkg paths | grep -q '3D Measured Line String' || fail 'paths hold no time'
for layer in envelope deposit paths path_points impacts streamline reach_points runs; do
  ogrinfo -q runout.gpkg -sql "SELECT f_table_name FROM layer_styles WHERE f_table_name = '$layer' AND useAsDefault" | grep -q "$layer" || fail "$layer has no style"
done
ogrinfo -q runout.gpkg -sql 'SELECT area_m2 FROM envelope' | grep -q '= 136' || fail 'the envelope is not 136 m2'
