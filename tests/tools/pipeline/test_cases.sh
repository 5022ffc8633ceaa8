# Cases are side by side, the drawn values of each run are in the run table, and a fence without
# capacity is called a wall below its numbers.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v python3 >/dev/null || skip "needs python3"
site slope
sed -i -e 's/^duration_s = .*/duration_s = 3\nfriction_scatter_deg = 2/' slope/site.toml
cat >>slope/site.toml <<'TOML'
[object.foot]
polygon = [[500090, 5200230], [500150, 5200230], [500150, 5200246], [500090, 5200246]]
[hazard.class.all]
frequency_per_a = 0.01
TOML
far='[variant.far]\nground.slope.friction_deg = 15\nweight'
near='[variant.near]\nground.slope.friction_deg = 70\nmaterial.rock.friction_deg = 70\nweight'
variants slope "$far = 1\n$near = 1"
set -- RUNS=2 WITHOUT=no
made slope -j2 "$@" runout
prints "2 of 4 runs did not move"
prints "case far: 2 of 2 runs moved"
prints "case near: 0 of 2 runs moved, 0 % of the mass"
prints "totals over all runs use these case weights: far 0.5 (2 runs), near 0.5 (2 runs)"
if grep -q pooled err; then fail "weighed cases are said to be pooled: $(cat err)"; fi
made slope "$@" report
python3 - <<'PY' || fail "cases are not side by side"
import csv, json
cases = {c['case']: c for c in json.load(open('slope/out/runout.json'))['cases']}
assert list(cases) == ['far', 'near'], list(cases)
assert cases['far']['n_runs_moved'] == 2 and cases['near']['n_runs_moved'] == 0, cases
assert cases['far']['moved']['share_moved_1_m'] > .5 and cases['near']['moved']['share_moved_1_m'] == 0
rows = list(csv.DictReader(open('slope/out/runs.csv')))
assert sorted(r['case'] for r in rows) == ['far', 'far', 'near', 'near']
for case, mean in ('far', 15), ('near', 70):
    drawn = [float(r['friction_deg.slope']) for r in rows if r['case'] == case]
    assert drawn[0] != drawn[1] and all(0 < abs(d - mean) < 8 for d in drawn), drawn
page = open('slope/out/report.html').read()
assert '2 of 2' in page and '0 of 2' in page and 'mass that moved more than 1 m' in page
assert page.count('the fence is a rigid wall') >= 2, page.count('the fence is a rigid wall')
PY

# Maps of each case are side by side, in one window.
python3 - <<'PY' || fail "maps of the cases are not side by side"
page = open('slope/out/report.html').read()
for words in 'Maps case by case', 'maps/far/reach.tif', 'maps/near/ke_total.tif', 'All cases together, by their weights':
    assert words in page, words
PY
for case in far/ near/ ''; do
  gdalinfo "slope/out/maps/${case}reach.tif" | grep PICTURE_CELLS || fail "maps/${case}reach.tif has no page"
done | sort -u | wc -l | grep -qx 1 || fail "pages of the cases do not show the same cells"
unzip -p slope/out/site.qgz site.qgs | grep -q 'name="Case far"' || fail "the project has no maps of the cases"

# Weighed: a share of all is the weighed mean of the cases' own, in maps, fences and run-out alike.
variants slope "$far = 1"
expect 2 make -C slope BIN= "$@" runout
says "[variant.far] alone has a weight"
variants slope "$far = 1\n$near = 3"
made slope "$@" MAPS_FLAGS= maps runout
made slope "$@" MAPS_FLAGS= report
grep -q "All cases together, by their weights" slope/out/report.html || fail "the page does not say that cases are weighed"
for case in far near; do
  expect 0 talus-maps slope/out/runs/$case --trn slope/out/bed.tif -o maps_$case --no-db
  for band in 1 2; do
    [ "$(gdalinfo -checksum maps_$case/reach.tif | grep -m $band Checksum | tail -n 1)" = \
      "$(gdalinfo -checksum slope/out/maps/$case/reach.tif | grep -m $band Checksum | tail -n 1)" ] ||
      fail "maps/$case is not that of case $case"
  done
done
expect 1 talus-maps slope/out/runs/far --trn slope/out/bed.tif -o maps_x --cell-size-m 16 --pages png \
  --window-of slope/out/maps/reach.tif --no-db
says "give both the same --cell-size-m"
expect 1 talus-maps slope/out/runs/far --trn slope/out/bed.tif -o maps_x --pages png \
  --window-of slope/out/trn.tif --no-db
says "does not say which cells its picture shows"
PATH=/usr/bin:$PATH python3 - <<'PY' || fail "maps do not weigh the cases"
import json
try:
    from osgeo import gdal
except ImportError:
    raise SystemExit(0)
def band(folder, name):
    data = gdal.Open(folder + '/reach.tif')
    for i in range(1, data.RasterCount + 1):
        if data.GetRasterBand(i).GetDescription() == name:
            return data.GetRasterBand(i).ReadAsArray()
for name in 'reach_probability', 'run_share':
    all_, far, near = (band(f, name) for f in ('slope/out/maps', 'maps_far', 'maps_near'))
    assert far.max() > 0 and abs(far - near).max() > .02, (name, far.max())
    assert abs(all_ - .25 * far - .75 * near).max() < 1e-6, name
tags = gdal.Open('slope/out/maps/reach.tif').GetMetadata()
assert tags['CASES'] == 'far 0.25 (2 runs), near 0.75 (2 runs)' and 'REMARK' not in tags, tags
r = json.load(open('slope/out/runout.json'))
far, near = r['cases']
assert r['n_events'] == 2 and abs(r['event_probability'] - .25) < 1e-12, r['event_probability']
assert abs(r['moved']['share_moved_1_m'] - .25 * far['moved']['share_moved_1_m']) < 1e-12
assert (far['weight'], near['weight']) == (.25, .75)
PY

# So do hits, frequencies and hazard maps of the one class, which has all cases.
made slope "$@" trace hazard
if grep -q pooled err; then fail "weighed cases are said to be pooled: $(cat err)"; fi
for case in far near; do
  expect 0 talus-trace slope/site.toml slope/out/runs/$case --trn slope/out/bed.tif -o $case.gpkg --json $case.json --no-db
  expect 0 talus-hazard slope/site.toml slope/out/runs/$case --trn slope/out/bed.tif -o hazard_$case --no-db
done
PATH=/usr/bin:$PATH python3 - <<'PY' || fail "objects and hazard maps do not weigh the cases"
import json
def foot(name): return json.load(open(name + '.json'))['objects'][0]
all_, far, near = foot('slope/out/trace'), foot('far'), foot('near')
assert far['hits_a_run'] > 0 == near['hits_a_run'], (far['hits_a_run'], near['hits_a_run'])
for key in 'hits_a_run', 'run_share', 'block_share', 'volume_share', 'deposited_m3_a_run':
    assert abs(all_[key] - .25 * far[key]) < 1e-12, (key, all_[key], far[key])
assert abs(all_['frequency_per_a'][0] - .25 * .01 * far['run_share']) < 1e-12, all_['frequency_per_a']
try:
    from osgeo import gdal
except ImportError:
    raise SystemExit(0)
def bands(folder, name):
    data = gdal.Open(f'{folder}/{name}.tif').ReadAsArray()
    data[data == -9999] = 0  # nothing came
    return data
for name in 'event_exceed', 'passage_frequency':
    all_, far, near = (bands(f, name)[0] for f in ('slope/out/hazard', 'hazard_far', 'hazard_near'))
    assert far.max() > 0 and abs(all_ - .25 * far - .75 * near).max() < 1e-6, name
PY

# The two bounds of a slide: a percentile of each.
variants slope '[variant.constant]\nweight = 1\n[variant.weakening]\nweight = 1\nsolver.friction = "weakening"'
made slope OUT=bounds RUNS=1 WITHOUT=no runout
prints "case weakening: 1 of 1 run moved"
python3 - <<'PY' || fail "the bounds of friction are not those"
import json
cases = {c['case']: c for c in json.load(open('slope/bounds/runout.json'))['cases']}
assert list(cases) == ['constant', 'weakening'], list(cases)
assert all(set(c['percentiles']) == {'share_left_source', 'rockfalls', 'rock_avalanches', 'at_least'} for c in cases.values())
far = [c['spread_over_runs']['L95_m']['max'] for c in cases.values()]
assert far[1] > 1.05 * far[0], far
PY

# All of it goes with the rest.
made slope clean
made slope OUT=bounds clean
[ ! -d slope/out ] || fail "clean left: $(find slope/out -type f)"
