# Boxes slide down a plane: crossings of a line drawn afterwards are those that the runs recorded at
# the same line, and the closed form; without frames none is missed.
run-probe . 12 blocks=3
line='250030,350004 250030,350020'
outputs='--tables t --json p.json --overwrite'
expect 0 talus-profile run_*.h5 --trn slope.tif --line "$line" -o p.gpkg $outputs
prints 'line of 16 m: 24 blocks cross it in 12 of 12 runs (95 %: 0.758 - 1), 2 a run, 66.7 % of the mass; energy up to '
prints '; by frames'
expect 0 talus-fence site.toml run_*.h5 --trn slope.tif -o f.gpkg --csv f.csv
cat >check.py <<'PY'
import csv, json, math
p = json.load(open('p.json'))
rows = {(r['run_id'], r['block']): r for r in csv.DictReader(open('t/crossings.csv'))}
recorded = {(r['run_id'], r['block']): r for r in csv.DictReader(open('f.csv')) if r['recorded_at'] == 'crossing'}
recorded = {k: r for k, r in recorded.items() if 0 <= float(r['chainage_m']) <= 16}
assert set(rows) == set(recorded) and len(rows) == 24, (len(rows), len(recorded))
cos = math.cos(math.pi / 6)
for key, row in rows.items():
    scale = 1 + 0.01 * (int(key[0][5:]) - 100000)
    energy = 2600 * 3 * scale * 19 / cos / 1e3  # m a s, from x = 11 to x = 30
    assert abs(float(row['energy_kj']) - energy) < 1e-5 * energy, (row['energy_kj'], energy)
    r = recorded[key]
    assert abs(float(r['energy_kj']) - energy) < 1e-5 * energy
    assert abs(float(row['chainage_m']) - float(r['chainage_m'])) < 1e-6
    assert abs(float(row['time_s']) - float(r['time_s'])) < 2e-3
    # the line lies along a contour: its base is the ground
    assert abs(float(row['top_height_m']) - float(r['top_height_m'])) < 1e-5, (row, r)
    assert abs(float(row['bottom_height_m']) - float(r['bottom_height_m'])) < 1e-5
    assert row['direction'] == '-1' and row['n_crossings'] == '1' and row['method'] == 'frames'
a = p['across']
assert a['method'] == 'frames' and a['n_runs_by_frames'] == 12 and a['frame_interval_s'] == 0.1
assert a['whole']['n_crossings'] == 24 and abs(a['whole']['mass_kg_a_run'] - 2 * 2600) < 1e-6
assert sum(b['n_crossings'] for b in a['bins']) == 24 and 10 <= len(a['bins']) <= 25
assert 0 < a['energy_change_p95'] < 0.1 and 'by frames 0.1 s apart' in a['error']
stations = p['along']['stations']
assert [s['chainage_m'] for s in stations] == [2.0 * i for i in range(9)]
ground = 200 - math.tan(math.pi / 6) * 30
assert all(abs(s['ground_m'] - ground) < 1e-9 for s in stations)
assert stations[3]['n_blocks'] > 0 and stations[3]['energy_max_kj'] >= 2600 * 3 * 1.11 * 19 / cos / 1e3
assert stations[0]['energy_max_kj'] is None and stations[0]['n_blocks'] == 0  # y = 4: no box comes there
PY
python3 check.py || fail 'the crossings are others'
[ "$(cd t && ls *.svg)" = "$(printf 'count.svg\nenergy.svg\nground.svg\nheight.svg\nspeed.svg')" ] || fail "charts: $(ls t)"
for chart in t/*.svg; do
  python3 -c "import sys, xml.dom.minidom; xml.dom.minidom.parse('$chart')" || fail "$chart is no XML"
  if grep -q nan "$chart"; then fail "$chart holds nan"; fi
done
for layer in crossings line_bins stations; do ogrinfo -q p.gpkg | grep -q "$layer" || fail "no layer $layer"; done
[ "$(ogrinfo -so p.gpkg crossings | sed -n 's/Feature Count: //p')" = 24 ] || fail 'not a point a crossing'
cp t/crossings.csv frames.csv

# a file in another system is the same line
printf '{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[250030,350004],[250030,350020]]}}' >l.geojson
ogr2ogr -a_srs EPSG:31254 l.gpkg l.geojson -nln road
expect 0 talus-profile run_*.h5 --trn slope.tif --line-file l.gpkg -o p.gpkg $outputs
cmp t/crossings.csv frames.csv || fail 'a file gives other crossings than --line'

# without frames: none is missed, values are bounds
expect 0 talus-reduce run_*.h5 --trn slope.tif -o part.h5
expect 0 talus-profile part.h5 --trn slope.tif --line "$line" -o p.gpkg $outputs
says '12 runs of 12 have no frames'
prints '; by cells'
cat >bounds.py <<'PY'
import csv, json
frames, cells = [{(r['run_id'], r['block']): r for r in csv.DictReader(open(f))} for f in ('frames.csv', 't/crossings.csv')]
assert set(frames) <= set(cells)
for key, row in frames.items():
    assert float(cells[key]['energy_kj']) >= float(row['energy_kj']) * (1 - 1e-6)
    assert float(cells[key]['speed_m_s']) >= float(row['speed_m_s']) * (1 - 1e-6)
    assert float(cells[key]['top_height_m']) >= float(row['top_height_m']) - 1e-6
a = json.load(open('p.json'))['across']
assert a['method'] == 'cells' and a['frame_interval_s'] is None and 'upper bounds' in a['error']
PY
python3 bounds.py || fail 'cells are no bounds'
cp t/stations.csv part_s.csv && cp t/crossings.csv part_c.csv

# parts and runs in any order; of those with frames, frames tell
expect 0 talus-reduce run_1.h5 run_4.h5 run_7.h5 --trn slope.tif -o a.h5
expect 0 talus-profile run_9.h5 a.h5 run_0.h5 run_11.h5 run_10.h5 run_2.h5 run_3.h5 run_5.h5 run_6.h5 run_8.h5 --trn slope.tif --line "$line" -o p.gpkg $outputs
prints 'by frames and cells'
cmp t/stations.csv part_s.csv || fail 'the profile along the line depends on how runs are spread'
grep -v cells t/crossings.csv >of_frames
[ "$(wc -l <of_frames)" = 19 ] || fail 'not two crossings of each of nine runs'
[ -z "$(grep -vxFf frames.csv of_frames)" ] || fail 'crossings by frames depend on the other runs'
