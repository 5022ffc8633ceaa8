# Forests: drawn in a polygon, from rasters, from a list; the same bytes. Forests that are refused:
# tests/unit/setup/test_forest_inputs.cpp.
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

# each run may draw its own stand
expect 0 talus-dda drawn.toml --trn slope.tif --blocks blocks.h5 -o other.h5 --no-db \
  --set forest.wood.new_stand_per_run=true
cmp -s drawn.h5 other.h5 && fail 'a stand of the run is that of all runs'

# layers, and the words of the evaluation
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
expect 0 talus-dda none.toml --trn slope.tif --blocks blocks.h5 -o x.h5 --no-db --set solver.law=paper --set solver.blocks=alone \
  --set solver.duration_s=0.001 --set solver.time_step_s=1e-4 --set solver.normal_stiffness_n_m=1e9 --set forest.wood.active=true
says 'forests stop nothing with law paper'

# refused forests, with a remedy
refused() {  # LINES TEXT
  with_forest bad "$1"
  expect 1 run bad -q
  says "$2"
  nothing_left bad.h5
}
refused 'stems_per_ha = 400' 'forest.wood: does not say where it stands'

# diameters in another unit, in any kind of file
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

# whole numbers of 8 bits are stems, centimetres and per cent as any
if command -v gdal_translate >/dev/null; then
  for name in nrtrees dbhmean dbhstd conif; do
    raster $name.asc 100 100
    gdal_translate -q -ot Byte -a_nodata none -a_srs EPSG:32632 $name.asc $name.tif
  done
  with_forest bytes 'nrtrees_raster = "nrtrees.tif"\ndbhmean_raster = "dbhmean.tif"\ndbhstd_raster = "dbhstd.tif"\nconif_percent_raster = "conif.tif"'
  expect 0 run bytes --json
  says 'forest.wood: 100 stems a hectare, conifers 100 %'
fi
