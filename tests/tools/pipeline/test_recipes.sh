# The designed slope by two recipes of different kind: any rock that comes (Norway), and the risk of
# the people there. A recipe of risk without people is refused before the runs; with it nothing is
# computed again but what it says.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
cat >>slope/site.toml <<'TOML'
[hazard]
recipe = "new_zealand_christchurch"
[hazard.class.all]
frequency_per_a = 0.002
TOML
expect 2 make -C slope BIN= RUNS=2 report
says 'is of risk, and the site has no object'
[ -z "$(ls slope/out/runs/run_*.h5 2>/dev/null)" ] || fail 'runs were computed before the recipe was refused'

sed -i 's/new_zealand_christchurch/norway_tek17/' slope/site.toml
cat >>slope/site.toml <<'TOML'
[object.road]
position_m = PLACE
radius_m = 30
TOML
place=$(ogr2ogr -f CSV /vsistdout/ slope/out/blocks.gpkg -dialect SQLite -sql "SELECT ST_X(ST_Centroid(geom)) x, ST_Y(ST_Centroid(geom)) y FROM blocks LIMIT 1" 2>/dev/null | tail -1)
sed -i "s/PLACE/[$place]/" slope/site.toml
made slope RUNS=2 report
gdalinfo slope/out/hazard/class.tif | grep -q '2: 251,106,74,255' || fail 'the map does not have the colours of the recipe'
for words in 'Norway, TEK17' 'too often for S2 and S3'; do
  grep -q "$words" slope/out/report.html || fail "the report does not say: $words"
done
grep -q 'residual hazard' slope/out/report.html && fail 'the report speaks of classes that the recipe does not have'
ogrinfo -q slope/out/hazard/hazard.gpkg layer_styles | grep -q 'too often for S2 and S3' || fail 'QGIS does not show the recipe'
cksum slope/out/runs/run_1.h5 >before

sed -i -e 's/norway_tek17/new_zealand_christchurch/' \
  -e 's/^radius_m = 30/&\npresence = 0.5\nvulnerability = [0.5]\npersons_per_day = 20/' slope/site.toml
made slope RUNS=2 report
cksum slope/out/runs/run_1.h5 | cmp - before || fail 'who is there made the runs anew'
[ ! -e slope/out/hazard/class.tif ] || fail 'the map of the recipe before is still there'
python3 - <<'PY' || fail 'the risk of the road'
import json, math
road, = json.load(open('slope/out/trace.json'))['objects']
assert road['n_runs_hit'] == 2, road
assert abs(road['risk']['individual_per_a'][0] - (1 - math.exp(-0.5 * 0.5 * 0.002))) < 1e-9, road['risk']
assert road['risk']['class'] == 'intolerable'
PY
for words in 'annual individual risk' 'intolerable: one in 10,000' 'New Zealand, Christchurch'; do
  grep -q "$words" slope/out/report.html || fail "the report does not say: $words"
done
on_page slope/out/trace.gpkg
made slope RUNS=2 report
prints 'Nothing to be done'
