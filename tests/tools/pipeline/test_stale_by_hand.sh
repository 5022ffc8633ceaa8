# A report that is called by hand beside the registry: it leaves out files that it knows from other
# work, and names inputs that have changed since.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
cat >slope/fence.geojson <<'END'
{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[500060,5200140],[500164,5200140]]}}]}
END
sed -i 's/^line = .*/file = "fence.geojson"/' slope/site.toml
made slope
sed -i 's/5200140/5200150/g' slope/fence.geojson
made slope  # the terrain is that of the first make
report() { expect 0 talus-report slope/site.toml --dir slope/out -o slope/out/report.html --qgis slope/out/site.qgz --overwrite; }
report
[ ! -s err ] || { cat err >&2; fail "something of one make is stale"; }

sed -i 's/5200150/5200190/g' slope/fence.geojson
report
says "fence.geojson: has changed since talus-dda read it"
sed -i 's/5200190/5200150/g' slope/fence.geojson
touch slope/contours.gpkg
report
[ ! -s err ] || fail "an input that was touched counts as changed"

# a second cut by hand, whose report takes the place of the first one's
sed 's/^spacing_m = 7.8/spacing_m = 10/' slope/site.toml >slope/other.toml
expect 0 talus-blocks slope/other.toml --trn slope/out/trn.tif -o slope/out/other.h5 --report slope/out/blocks.json --overwrite
report
says "left out: blocks.json: of a run of talus-blocks that these results were not made from"

# runs of another seed, evaluated without the pictures
expect 0 talus-dda slope/site.toml --trn slope/out/bed.tif --blocks slope/out/blocks.h5 -o slope/out/runs/run_2.h5 --seed 2
expect 0 talus-runout slope/out/runs/run_2.h5 --trn slope/out/bed.tif -o slope/out/runout.gpkg --json slope/out/runout.json --overwrite
report
says "left out: runout.svg: of a run of talus-runout that these results were not made from"
says "left out: curves.csv: not of the runs that runout.json is of"

# grounds that overlap, in another order
strip() { printf '[ground.%s]\npolygon = [[500080, 5200150], [500160, 5200150], [500160, 5200245]]\nfriction_deg = %s\n' "$1" "$2"; }
{ cat slope/site.toml && strip scree 35 && strip grass 20; } >slope/one.toml
{ cat slope/site.toml && strip grass 20 && strip scree 35; } >slope/two.toml
mkdir -p by_hand/runs
cp slope/out/bed.tif slope/out/trn.tif by_hand
expect 0 talus-dda slope/one.toml --trn by_hand/bed.tif --blocks slope/out/blocks.h5 -o by_hand/runs/run_1.h5 --no-db
expect 0 talus-runout by_hand/runs/run_1.h5 --trn by_hand/bed.tif -o by_hand/runout.gpkg --json by_hand/runout.json --no-db
expect 0 talus-report slope/one.toml --dir by_hand -o report.html --no-db
expect 1 talus-report slope/two.toml --dir by_hand -o report.html --no-db --overwrite
says "was computed with other settings than the site file has: order of [ground.*]: "
