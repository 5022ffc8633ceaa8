# Forests: drawn in a polygon, from rasters, from a list; what of them is refused; the same bytes.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
polygon='polygon = [[500050, 5000010], [500095, 5000010], [500095, 5000090], [500050, 5000090]]'

with_forest() {  # NAME LINES
  { cat site.toml && printf '[forest.wood]\n%b\n' "$2"; } >"$1.toml"
}
run() { talus-dda "$1.toml" --trn slope.tif --blocks blocks.h5 -o "$1.h5" --no-db "$2"; }

# drawn: blocks hit stems, break some, and the result says so; again it is the same, byte by byte
with_forest drawn "$polygon\nstems_per_ha = 1500\ndbh_mean_cm = 25\nconifer_share = 0.5"
expect 0 run drawn --json
cp out drawn.json
expect 0 talus-dda drawn.toml --trn slope.tif --blocks blocks.h5 -o again.h5 --no-db
cmp -s drawn.h5 again.h5 || fail 'two runs with a forest differ'
prints ' stems hit, '
expect 0 talus-dda drawn.toml --trn slope.tif --blocks blocks.h5 --no-db --plan
prints 'on   forest: 1 forest'

# each run may draw a stand of its own
expect 0 talus-dda drawn.toml --trn slope.tif --blocks blocks.h5 -o other.h5 --no-db \
  --set forest.wood.new_stand_per_run=true
cmp -s drawn.h5 other.h5 && fail 'a stand of the run is that of all runs'

# layers, and what the evaluation says
expect 0 talus-runout drawn.h5 --trn slope.tif -o runout.gpkg --json runout.json --no-db -q
PATH=/usr/bin:$PATH python3 - <<'PY' || fail 'hits of trees'
import json, sqlite3
report = json.load(open('drawn.json'))['trees']
assert 350 < report['n_stems'] < 750, report  # 0.36 ha of 1500 a hectare, clear of the blocks
assert report['n_stems_hit'] >= report['n_stems_broken'] >= 1, report
trees = json.load(open('runout.json'))['trees']
forest, = trees['forests']
assert forest['stems'] == report['n_stems'] and forest['broken'] == report['n_stems_broken']
assert abs(forest['work_kj'] - report['work_kj']) < 1e-6 * report['work_kj']
layers = sqlite3.connect('runout.gpkg')
rows = layers.execute('select stem, dbh_cm, capacity_kj, n_hits, n_broken, largest_work_kj, least_left_kj from trees_hit').fetchall()
assert len(rows) == report['n_stems_hit']
for stem, dbh, capacity, n, broken, work, left in rows:
    factors = [0.93, 1.59]
    assert any(abs(capacity - f * 0.0387 * dbh ** 2.31) < 1e-6 * capacity for f in factors), (dbh, capacity)
    assert (left == 0) == (broken == 1) and work <= capacity * (1 + 1e-6)
taken, = layers.execute('select sum(work_kj) from tree_hits').fetchone()
assert abs(taken - report['work_kj']) < 1e-6 * taken
PY

# a list, with species, one stem off the terrain
cat >stems.geojson <<'END'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}}, "features": [
{"type": "Feature", "properties": {"dbh_cm": 60, "species": "oak"}, "geometry": {"type": "Point", "coordinates": [500060, 5000050]}},
{"type": "Feature", "properties": {"dbh_cm": 12.5, "conifer": 0}, "geometry": {"type": "Point", "coordinates": [500050, 5000030]}},
{"type": "Feature", "properties": {"dbh_cm": 20}, "geometry": {"type": "Point", "coordinates": [400000, 5000030]}}]}
END
with_forest list 'stems_file = "stems.geojson"'
expect 0 run list --json
prints '"n_stems": 2'
says 'forest.wood: 1 of 3 stems lie off the known ground, left out'

# rasters of 20 m as Rockyfor3D has them: trees in the west half of the wood alone
raster() {  # FILE VALUE_WEST VALUE_EAST
  { printf 'ncols 4\nnrows 5\nxllcorner 500040\nyllcorner 5000000\ncellsize 20\nNODATA_value -9999\n'
    for row in 1 2 3 4 5; do echo "$2 $2 $3 $3"; done; } >"$1"
}
raster nrtrees.asc 2000 0
raster dbhmean.asc 18 18
raster dbhstd.asc 5 5
raster conif.asc 100 0
rasters='nrtrees_raster = "nrtrees.asc"\ndbhmean_raster = "dbhmean.asc"\ndbhstd_raster = "dbhstd.asc"'
with_forest rasters "$rasters\nconif_percent_raster = \"conif.asc\""
expect 0 run rasters --json
PATH=/usr/bin:$PATH python3 - <<'PY' || fail 'stems of rasters'
import json
n = json.load(open('out'))['trees']['n_stems']
assert abs(n - 800) < 4 * 800 ** 0.5, n  # 0.4 ha
PY

# drag instead of stems: blocks stop sooner, the plan and the log say so
displacement() { sed -n 's/.*"displacement_p90_m": \([0-9.]*\).*/\1/p' out | head -n 1; }
with_forest drag "$polygon\ndrag_kg_s = 20000"
expect 0 run drag --json
says 'forest.wood: drag of 20000 kg/s on 0.36 ha'
dragged=$(displacement)
grep -q trees out && fail 'a forest without stems is told of as one of stems'
expect 0 talus-dda drag.toml --trn slope.tif --blocks blocks.h5 -o still.h5 --no-db --json \
  --set forest.wood.active=false
awk "BEGIN { exit !($dragged < 0.8 * $(displacement)) }" ||
  fail "through the wood $dragged m, without it $(displacement) m"
expect 0 talus-dda drag.toml --trn slope.tif --blocks blocks.h5 --no-db --plan
prints 'on   drag of forests: 1 forest'
grep -q 'on   forest:' out && fail 'the plan tells of stems'

# nothing of it where there is none: no table, no line, the same bytes
with_forest none "$polygon\nstems_per_ha = 400\nactive = false"
expect 0 run none --json
grep -q trees out && fail 'a forest that does not stand is told of'
expect 0 talus-dda none.toml --trn slope.tif --blocks blocks.h5 -o x.h5 --no-db --law paper --independent \
  --duration-s 0.001 --time-step-s 1e-4 --set solver.normal_stiffness_n_m=1e9 --set forest.wood.active=true
says 'forests stop nothing with law paper'

# what is refused, with a way out
refused() {  # LINES TEXT
  with_forest bad "$1"
  expect 1 run bad -q
  says "$2"
  nothing_left bad.h5
}
refused 'stems_per_ha = 400' 'forest.wood: does not say where it stands'
refused "$polygon" 'does not say how many stems there are'
refused "$polygon\nstems_per_ha = 400\nstems_file = \"stems.geojson\"" 'has both stems_file and polygon'
refused "$polygon\nstems_per_ha = 400\nnrtrees_raster = \"nrtrees.asc\"" 'has both stems_per_ha and nrtrees_raster'
refused "$rasters\ndbh_mean_cm = 30" 'has both dbh_mean_cm and dbhmean_raster'
refused "$polygon\nstems_per_ha = 400\ndbhstd_raster = \"dbhstd.asc\"" 'has dbhstd_raster without nrtrees_raster'
refused "$polygon\nstems_per_ha = 400\ndbh_mean_cm = 0" 'dbh_mean_cm is 0, expected above 0'
refused "$polygon\nstems_per_ha = 400\ndeflection_m = 0" 'deflection_m is 0, expected above 0'
refused 'polygon = [[600050, 5000010], [600095, 5000010], [600095, 5000090]]\nstems_per_ha = 400' \
  'forest.wood: lies outside the terrain'
refused "$polygon\nstems_per_ha = 0.01" 'forest.wood: has no stem on the terrain'
refused "$polygon\nstems_per_ha = 400\ndbh_cm = 3" 'unknown key dbh_cm'
refused "$polygon\ndrag_kg_s = -1" 'drag_kg_s is -1, expected 0 to 1e+05'
refused 'drag_kg_s = 500' 'forest.wood: does not say where it drags'
for stems in 'stems_per_ha = 400' 'stems_file = "stems.geojson"' 'nrtrees_raster = "nrtrees.asc"'; do
  refused "$polygon\ndrag_kg_s = 500\n$stems" "forest.wood: has both drag_kg_s and ${stems%% *}"
done
refused 'polygon = [[600050, 5000010], [600095, 5000010], [600095, 5000090]]\ndrag_kg_s = 500' \
  'forest.wood: lies outside the terrain'
raster nothing.asc 0 0
refused 'nrtrees_raster = "nrtrees.asc"\ndbhmean_raster = "nothing.asc"' 'dbhmean_raster is 0 where nrtrees_raster has trees'
raster percent.asc 150 150
refused 'nrtrees_raster = "nrtrees.asc"\nconif_percent_raster = "percent.asc"' 'conif_percent_raster is 150'
sed 's/cellsize 20/cellsize 10/' dbhmean.asc >other.asc
refused 'nrtrees_raster = "nrtrees.asc"\ndbhmean_raster = "other.asc"' 'has other cells than nrtrees_raster'
sed 's/500040/700040/' nrtrees.asc >away.asc
refused 'nrtrees_raster = "away.asc"' 'nrtrees_raster lies outside the terrain'
sed 's/"dbh_cm": 60/"dbh_cm": 0/' stems.geojson >thin.geojson
refused 'stems_file = "thin.geojson"' 'dbh_cm is 0, expected above 0'
sed 's/oak/oka/' stems.geojson >oka.geojson
refused 'stems_file = "oka.geojson"' 'species is oka'
sed 's/500050, 5000030/500020, 5000030/' stems.geojson >inside.geojson
refused 'stems_file = "inside.geojson"' 'stands in block 0 at the start'
sed 's/\[500060, 5000050\]/[300000, 5000050]/; s/\[500050, 5000030\]/[300000, 5000030]/' stems.geojson >off.geojson
refused 'stems_file = "off.geojson"' 'forest.wood: has no stem on the terrain'

# two sections on the same ground count twice: said; one stem in two lists is refused
{ cat drawn.toml && printf '[forest.again]\n%b\nstems_per_ha = 1500\n' "$polygon"; } >twice.toml
expect 0 run twice --json
says "warning: forest.again: 100 % of its area lies in forest.wood: there the stems of both stand"
half='polygon = [[500070, 5000010], [500110, 5000010], [500110, 5000090], [500070, 5000090]]'
{ cat drawn.toml && printf '[forest.fog]\n%b\ndrag_kg_s = 250\n' "$half"; } >layers.toml
expect 0 run layers --json
if grep -q 'lies in' err; then fail 'undergrowth below stems is no second stand'; fi
printf '[forest.mist]\n%b\ndrag_kg_s = 250\n' "$polygon" >>layers.toml
expect 0 talus-dda layers.toml --trn slope.tif --blocks blocks.h5 -o layers2.h5 --no-db
says "forest.mist: 56 % of its area lies in forest.fog: there the drag of both acts"
printf 'x,y,dbh_cm\n500060,5000030,40\n500060,5000050,40\n' >one_list.csv
{ cat site.toml && printf '[forest.a]\nstems_file = "one_list.csv"\n[forest.b]\nstems_file = "one_list.csv"\n'; } >lists.toml
expect 1 run lists --json
says "forest.b: has a stem where forest.a has one, at 500060, 5000030"
nothing_left lists.h5

# magnitudes show units that were not meant: half of the stems decide, not one of them
with_forest list 'stems_file = "stems.geojson"'
expect 0 run list --overwrite
says 'forest.wood: 2 stems, diameter 12.5 (12.5 to 60) cm, height 20 m'
with_forest drawn "$polygon\nstems_per_ha = 1500\ndbh_mean_cm = 25\ndbh_std_cm = 0\nconifer_share = 0.5"
expect 0 run drawn --overwrite
says 'forest.wood: 1500 stems a hectare, conifers 50 %'
says ' stems, diameter 25 cm, height 20 m'
listed() {  # DIAMETER: nine stems, eight of them so thick
  printf 'x,y,dbh_cm\n500060,5000030,30\n'
  for row in 1 2 3 4 5 6 7 8; do echo "500060,50000$((30 + 5 * row)),$1"; done
}
refused_unit() {  # NAME DIAMETER MESSAGE: as a table, and in a GeoPackage and a FlatGeobuf
  listed $2 >$1.csv
  for list in $1.csv $1.gpkg $1.fgb; do
    case $list in
      *.csv) ;;
      *) ogr2ogr -q $list $1.csv -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo AUTODETECT_TYPE=YES -a_srs EPSG:32632 ;;
    esac
    refused "stems_file = \"$list\"" "$3"
  done
}
if command -v ogr2ogr >/dev/null; then
  refused_unit metres 0.35 'half of the stems are thinner than 0.35 cm (0.35 to 30); read as metres it would be 35 cm'
  refused_unit millimetres 350 'half of the stems are thicker than 350 cm (30 to 350); read as millimetres it would be 35 cm'
fi
listed 1.2 >feet.csv
with_forest list 'stems_file = "feet.csv"'
expect 0 run list --overwrite
says 'warning: forest.wood: half of the stems are thinner than 1.2 cm'
refused "$polygon\nstems_per_ha = 400\ndbh_mean_cm = 0.3\ndbh_std_cm = 0.05" 'read as metres it would be 29.8 cm: that is no wood'
refused "$polygon\nstems_per_ha = 400\nheight_m = 250" 'has trees of 250 m, expected up to 130'
raster metres.asc 0.18 0.18
refused 'nrtrees_raster = "nrtrees.asc"\ndbhmean_raster = "metres.asc"' 'dbhmean_raster metres.asc holds diameters at breast height in centimetres'
raster shares.asc 0.8 0
refused "$rasters\nconif_percent_raster = \"shares.asc\"" 'has a conif_percent_raster of 0.8 %, in no cell more than 1 %'
raster cells.asc 16 0
with_forest cells 'nrtrees_raster = "cells.asc"'
expect 0 run cells --json
says 'nrtrees_raster has 16 stems a hectare: are they stems a cell? Then there are 400 a hectare'

# whole numbers of 8 bits are stems, centimetres and per cent as others
if command -v gdal_translate >/dev/null; then
  for name in nrtrees dbhmean dbhstd conif; do
    raster $name.asc 100 100
    gdal_translate -q -ot Byte -a_nodata none -a_srs EPSG:32632 $name.asc $name.tif
  done
  with_forest bytes 'nrtrees_raster = "nrtrees.tif"\ndbhmean_raster = "dbhmean.tif"\ndbhstd_raster = "dbhstd.tif"\nconif_percent_raster = "conif.tif"'
  expect 0 run bytes --json
  says 'forest.wood: 100 stems a hectare, conifers 100 %'
fi
