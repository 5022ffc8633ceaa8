# Boxes that slide straight down a plane, each run by one per cent farther: the ranks of
# observations among them has closed forms.
run-probe . 12 blocks=3 independent=1
collection() { # collection FILE EPSG FEATURES
  printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:%s"}},"features":[%s]}\n' "$2" "$3" >"$1"
}
point() { printf '{"type":"Feature","properties":{%s},"geometry":{"type":"Point","coordinates":[%s]}}' "$2" "$1"; }
area() { printf '{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[%s]]}}' "$1"; }
collection boulders.geojson 31254 "$(point 250043.5,350016 '"volume_m3":1.5,"date":"2019-05-03"'),$(point 250044.5,350017 ''),$(point 250070,350016 '"volume_m3":0.5')"
collection scars.geojson 31254 "$(point 250031,350017 '"height_m":0.65'),$(point 250071,350017 '"height_m":2')"
collection outline.geojson 31254 "$(area '[250040,350013],[250060,350013],[250060,350030],[250040,350030],[250040,350013]')"
cp site.toml plain.toml
printf '[observed.may]\nboulders_file = "boulders.geojson"\nscars_file = "scars.geojson"\noutline_file = "outline.geojson"\n' >>site.toml
calibrate() { talus-calibrate "$1" run_*.h5 --trn slope.tif -o calibrate.gpkg --json calibrate.json --overwrite --no-db; }
expect 0 calibrate site.toml
prints 'may: n = 3 points cannot tell the median (6 can) nor the 10th and 90th percentiles (36 can); 66.7 % of them lie in the computed reach'
prints 'may: computed blocks pass 1 of 2 scars'
cat >check.py <<'PY'
import json, math, sys
event, = json.load(open(sys.argv[1]))['events']
ends = [(36 * math.cos(math.pi / 6) * (1 + 0.01 * r), 6 * (b - 1)) for r in range(12) for b in range(3)]
runouts = sorted(math.hypot(*end) for end in ends)  # from the mean start, (11, 16)
seen = [(32.5, 0), (33.5, 1), (59, 0)]
direction = [sum(p[k] for p in seen) for k in (0, 1)]
length = math.hypot(*direction)
b = event['boulders']
assert b['n'] == 3 and abs(b['start_m'][0] - 250011) < 1e-6 and abs(b['start_m'][1] - 350016) < 1e-6, b['start_m']
for p, row in zip(seen, b['points']):
    runout = math.hypot(*p)
    assert abs(row['runout_m'] - runout) < 1e-6
    across = (p[1] * direction[0] - p[0] * direction[1]) / length
    assert abs(row['across_m'] - across) < 1e-6
    assert abs(row['percentile'] - sum(x <= runout for x in runouts) / 36) < 1e-9, row
first, second, third = b['points']
assert (first['date'], first['volume_percentile'], third['volume_percentile']) == ('2019-05-03', 1, 0)
assert second['volume_m3'] is None and second['date'] is None
assert (first['in_reach'], third['in_reach']) == (1, 0) and third['percentile'] == 1
assert abs(b['mean_runout_m']['computed'] - sum(runouts) / 36) < 1e-3 and b['mean_runout_m']['low'] is None
assert all(level['low'] is None for level in b['runout_m']) and [l['needed'] for l in b['runout_m']] == [36, 6, 36]
hit, free = event['scars']['points']
# the centroid slides 0.6 m above the ground in the vertical
assert hit['n_passes'] == 12 and abs(hit['height_p50_m'] - 0.6) < 0.01 and hit['percentile'] == 1, hit
assert free['n_passes'] == 0 and free['percentile'] is None
# boxes 1 and 2 end within x from 40 to 60, y from 13 to 30
assert abs(event['outline']['inside_share'] - 2 / 3) < 1e-9 and 0 < event['outline']['reached_share'] < 1
PY
python3 check.py calibrate.json || fail 'the scores are others'
for layer in observed_boulders observed_scars observed_outlines; do ogrinfo -q calibrate.gpkg | grep -q "$layer" || fail "no layer $layer"; done
python3 "$source_dir/tests/tools/fields.py" "$source_dir/docs/reference/fields.md" calibrate.gpkg || fail fields

# from parts, and from layers in another coordinate system: the same
expect 0 talus-reduce run_0.h5 run_3.h5 run_6.h5 run_9.h5 --trn slope.tif -o a.h5 --no-db
mkdir parts
cp a.h5 run_1.h5 run_2.h5 run_4.h5 run_5.h5 run_7.h5 run_8.h5 run_1?.h5 parts/
expect 0 talus-calibrate site.toml parts/*.h5 --trn slope.tif -o parts.gpkg --json parts.json --no-db
python3 check.py parts.json || fail 'parts give other scores'
mkdir far
for name in boulders scars outline; do ogr2ogr -q -t_srs EPSG:31255 far/$name.gpkg $name.geojson; done
sed -e 's#= "\(boulders\|scars\|outline\).geojson"#= "far/\1.gpkg"#' site.toml >far.toml
expect 0 calibrate far.toml
python3 - <<'PY' || fail 'another system gives other places'
import json
here, there = (json.load(open(f'{name}.json'))['events'][0] for name in ('parts', 'calibrate'))
for a, b in zip(here['boulders']['points'], there['boulders']['points']):
    assert abs(a['x_m'] - b['x_m']) < 1e-3 and a['percentile'] == b['percentile']
assert abs(here['outline']['inside_share'] - there['outline']['inside_share']) < 1e-9
PY

# implausible observations
bad() { # bad FILE FEATURES WORDS: a layer in place of the good one
  cp "$1" kept
  collection "$1" 31254 "$2"
  expect 1 talus-calibrate site.toml run_*.h5 --trn slope.tif -o bad.gpkg --no-db
  says "$3"
  nothing_left bad.gpkg
  mv kept "$1"
}
bad scars.geojson "$(point 250031,350017 '"height_m":-1')" 'point 1: height_m is -1, expected 0 to 100'
bad scars.geojson "$(point 250031,350017 '')" 'has no height_m'
bad boulders.geojson "$(point 250031,350017 '"volume_m3":"large"')" 'volume_m3 is large, expected 1e-06 to 1e+06'
bad boulders.geojson "$(point 350016,250043 '')" 'observed_boulders of [observed.may] lies outside of the known terrain'
bad outline.geojson "$(area '[260040,350013],[260060,350013],[260060,350030],[260040,350013]')" 'observed_outlines of [observed.may] lies outside'
bad boulders.geojson "$(point 250043.5,350016 '"start_x_m":250011,"start_y_m":350010'),$(point 250044.5,350017 '')" \
  'has starts of 1 of 2 boulders, expected all or none'
bad boulders.geojson "$(point 250043.5,350016 '"start_x_m":250011')" 'starts at x "250011" and y "", expected two numbers'
cp boulders.geojson kept
collection boulders.geojson 31254 "$(point 250043.5,350011 '"start_x_m":250011,"start_y_m":350010')"
expect 0 calibrate site.toml
python3 - <<'PY' || fail 'with its own start a displacement is another one'
import json, math
b = json.load(open('calibrate.json'))['events'][0]['boulders']
assert b['own_starts'] and abs(b['points'][0]['runout_m'] - math.hypot(32.5, 1)) < 1e-6
# all boxes of a run slide as far, from their own starts
assert abs(b['mean_runout_m']['computed'] - 36 * math.cos(math.pi / 6) * 1.055) < 1e-3 and b['across_m']['computed'] < 1
PY
collection boulders.geojson 31254 "$(point 250043.5,350016 ''),$(point 250143.5,350016 '')"
expect 0 calibrate site.toml
says '1 of 2 points lie outside of the known terrain and are left out'
mv kept boulders.geojson
expect 1 calibrate plain.toml
says 'plain.toml: has no section [observed.*]'
printf '[observed.june]\n' >>plain.toml
expect 1 calibrate plain.toml
says '[observed.june] says nothing that was observed'
sed 's/boulders.geojson/none.geojson/' site.toml >none.toml
expect 1 calibrate none.toml
says 'none.geojson'
