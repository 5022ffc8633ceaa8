# All that a site names is imported in one run: sections read from there give the same results as
# from their own files; another file under the same name is refused, and one of another name is read.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
site here
cd here
feature() { printf '{"type":"Feature","properties":{%s},"geometry":{"type":"%s","coordinates":%s}}' "$1" "$2" "$3"; }
collection() {
  printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},"features":['
  sep=
  for one in "$@"; do printf '%s%s' "$sep" "$one"; sep=,; done
  printf ']}\n'
}
square() { printf '[[[%s,%s],[%s,%s],[%s,%s],[%s,%s],[%s,%s]]]' "$1" "$2" "$3" "$2" "$3" "$4" "$1" "$4" "$1" "$2"; }
collection "$(feature '' Polygon "$(square 500096 5200248 500144 5200296)")" >release.geojson
ogr2ogr -q -t_srs EPSG:25832 release.gpkg release.geojson
collection "$(feature '' LineString '[[500060,5200150],[500164,5200150]]')" >valley.geojson
ogr2ogr -q -t_srs EPSG:4326 valley.gpkg valley.geojson
collection "$(feature '' Polygon "$(square 500000 5200000 500224 5200100)")" \
  "$(feature '' Polygon "$(square 500020 5200090 500080 5200140)")" >meadow.geojson
collection "$(feature '"dbh_cm":41,"species":"spruce"' Point '[500100,5200120]')" \
  "$(feature '"dbh_cm":38.5' Point '[500120,5200124]')" >stems.geojson
collection "$(feature '' LineString '[[500010,5200040],[500200,5200060]]')" >road.geojson
collection "$(feature '' Point '[500050,5200050]')" >pole.geojson
gdal_translate -q -ot Byte -a_srs EPSG:32633 -a_ullr 499996 5200324 500228 5199996 -scale 0 1000 2 2 \
  "$source_dir/sample_sites/designed/slope.asc" classes.tif
sed -e 's/^polygon = .*/polygon_file = "release.gpkg"/' -e 's/^line = .*/file = "valley.gpkg"/' \
  -e 's/^\[terrain\]/&\nground_raster = "classes.tif"/' site.toml >new.toml
cat >>new.toml <<'END'
[ground.meadow]
friction_deg = 20
polygon_file = "meadow.geojson"
[ground.rough]
raster_values = [2]
[forest.wood]
stems_file = "stems.geojson"
[object.road]
file = "road.geojson"
width_m = 5
[object.pole]
file = "pole.geojson"
radius_m = 2
END
mv new.toml site.toml

expect 0 talus-import site.toml -o inputs.gpkg --report import.json
prints "source: 1 polygon"
prints "fence.valley: 1 line"
prints "terrain.ground_raster: 41 rows, 2 to 2, median 2"
prints "source: 1 polygon of 2304 m2 in all; reprojected from EPSG:25832"
prints "2 polygons of 24,800 m2 in all; 2 that overlap or touch were united to 1"
for layer in source fences grounds stems object_lines object_points; do
  ogrinfo -so inputs.gpkg $layer | grep -q '^name: String' || fail "no layer $layer with names"
done
ogrinfo -q inputs.gpkg stems | grep -q 'species (String) = spruce' || fail "a stem has lost its species"
ogrinfo -q inputs.gpkg decisions >decisions
for words in 'layer (String) = fence.valley' 'file (String) = valley.gpkg' 'answer (String) = used where it is'; do
  grep -qF "$words" decisions || fail "no decision says: $words"
done
expect 0 talus-import site.toml -o again.gpkg
cmp -s inputs.gpkg again.gpkg || fail "the same site gives other bytes"

# the same results from there, also by their ids
expect 0 talus-tin inputs.gpkg -o tin.ply
expect 0 talus-trn tin.ply -o trn.tif --cell-size-m 8 --window 500000,5200000,500224,5200320
for from in '' '--inputs inputs.gpkg'; do
  expect 0 talus-blocks site.toml --trn trn.tif -o blocks.h5 --trn-out bed.tif --overwrite --no-db $from
  expect 0 talus-dda site.toml --trn bed.tif --blocks blocks.h5 -o run.h5 --overwrite --no-db $from
  cksum blocks.h5 bed.tif run.h5 >sums
  [ -s first ] || mv sums first
done
cmp first sums || fail "the border changes blocks or runs"
says "inputs.gpkg: layer fences where source = "

# tools that are given the file read it, not its sources
expect 0 talus-source site.toml --trn trn.tif -o source.json --inputs inputs.gpkg --no-db
says "inputs.gpkg: layer source where source = 2, 1 polygon of 2304 m2 in all"
expect 0 talus-source site.toml --trn trn.tif -o source.json --overwrite --no-db \
  --inputs inputs.gpkg --set source.polygon_file=release.geojson
says "release.geojson: layer release, 1 polygon of 2304 m2 in all"

# stale, changed, of another system, none
cp valley.geojson valley.keep
sed -i 's/5200248/5200249/g' release.geojson
ogr2ogr -q -overwrite -t_srs EPSG:25832 release.gpkg release.geojson
expect 1 talus-source site.toml --trn trn.tif -o bad.json --inputs inputs.gpkg --no-db
says "inputs.gpkg: is older than release.gpkg: what it was made from was another file"
says "hint: write it anew: make, or talus-import SITE.toml -o inputs.gpkg --overwrite"
nothing_left bad.json
expect 0 talus-import site.toml -o inputs.gpkg --overwrite
expect 0 talus-source site.toml --trn trn.tif -o source.json --inputs inputs.gpkg --overwrite --no-db
cp inputs.gpkg moved.gpkg
ogrinfo -q moved.gpkg -sql "UPDATE source SET geom = (SELECT geom FROM grounds)" >/dev/null
expect 1 talus-source site.toml --trn trn.tif -o bad.json --inputs moved.gpkg --no-db
says "moved.gpkg: was changed since talus-import wrote it"
expect 0 talus-import site.toml -o other.gpkg --t-srs EPSG:32632
expect 0 talus-source site.toml --trn trn.tif -o source.json --inputs other.gpkg --overwrite --no-db
says "release.gpkg: layer release, 1 polygon"
expect 1 talus-source site.toml --trn trn.tif -o bad.json --inputs valley.gpkg --no-db
says "valley.gpkg: was not written by talus-import"
says "hint: leave --inputs out, or write it: talus-import SITE.toml -o inputs.gpkg"
expect 0 talus-source site.toml --trn trn.tif -o source.json --overwrite --no-db
cp contours.gpkg known.gpkg
ogrinfo -q contours.gpkg -sql "DELETE FROM contours WHERE fid = 1" >/dev/null
expect 1 talus-tin inputs.gpkg -o bad.ply
says "inputs.gpkg: is older than contours.gpkg"

# shapes written in the site file are beside those of files
expect 0 talus-import site.toml -o written.gpkg --set source.polygon_file= --set \
  'source.polygon=[[500096,5200248],[500144,5200248],[500144,5200296],[500096,5200296]]'
prints "source: 1 polygon of 2304 m2 in all"

# an elevation model stays where it is; its system is that of the site
gdal_translate -q -a_srs EPSG:32633 -a_ullr 499996 5200324 500228 5199996 "$source_dir/sample_sites/designed/slope.asc" dem.tif
sed -i -e 's/^contours = .*/dem = "dem.tif"/' -e '/^elevation_field/d' site.toml
expect 0 talus-import site.toml -o inputs.gpkg --overwrite
prints "dem: 41 rows, "
expect 0 talus-trn dem.tif -o trn.tif --overwrite
expect 0 talus-source site.toml --trn trn.tif -o source.json --inputs inputs.gpkg --overwrite --no-db
says "inputs.gpkg: layer source where source = 1"
expect 1 talus-import site.toml --set terrain.dem=classes.gpkg -o bad.gpkg
nothing_left bad.gpkg
