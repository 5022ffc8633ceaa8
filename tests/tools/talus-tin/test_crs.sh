# Coordinates that are not metres are refused with the option that mends them.
. "$source_dir/tests/tools/talus-tin/map.sh"
cone >map.geojson
expect 0 talus-tin map.geojson -o utm.ply --report utm.json
ogr2ogr -q -t_srs EPSG:4326 degrees.gpkg map.geojson
expect 1 talus-tin degrees.gpkg -o bad.ply
says "EPSG:4326 (WGS 84), in degrees, expected a projected one in metres"
says "hint: --t-srs EPSG:32632"
nothing_left bad.ply
# the hint works, and lands within a millimetre of the original
expect 0 talus-tin degrees.gpkg -o back.ply --t-srs EPSG:32632 --report back.json
[ "$(value back.json n_triangles)" = "$(value utm.json n_triangles)" ] || fail "other triangles after --t-srs"
area() { value "$1" area_m2; }
awk -v a="$(area utm.json)" -v b="$(area back.json)" 'BEGIN { exit !((a - b) ^ 2 < 1e-2) }' ||
  fail "area $(area back.json), expected $(area utm.json)"

# feet (Oregon, international feet), web mercator
cone 2992 >feet.geojson
expect 1 talus-tin feet.geojson -o bad.ply
says "of 0.3048 m, expected a projected one in metres"
cone 3857 >mercator.geojson
expect 1 talus-tin mercator.geojson -o bad.ply
says "EPSG:3857"
nothing_left bad.ply
ogr2ogr -q -a_srs ESRI:102100 web.gpkg mercator.geojson
expect 1 talus-tin web.gpkg -o bad.ply
says "whose metres are stretched here"

# a GeoPackage without CRS calls it undefined; a GeoJSON without crs means degrees for any values
for undefined in 0 -1; do
  ogr2ogr -q "undefined$undefined.gpkg" map.geojson
  ogrinfo -q "undefined$undefined.gpkg" -sql "UPDATE gpkg_geometry_columns SET srs_id = $undefined" >/dev/null
  ogrinfo -q "undefined$undefined.gpkg" -sql "UPDATE gpkg_contents SET srs_id = $undefined" >/dev/null
done
cone "" >without.geojson
for source in undefined0.gpkg undefined-1.gpkg without.geojson; do
  expect 1 talus-tin $source -o bad.ply
  says "hint: name it with --crs EPSG:code, or --crs none for local metres"
  expect 0 talus-tin $source -o named.ply --crs EPSG:32632 --overwrite
  data utm.ply >expected
  data named.ply >found
  cmp -s expected found || fail "$source with --crs gives other triangles"
  grep -qa '^comment crs EPSG:32632' named.ply || fail "the CRS given for $source does not stand in the file"
  expect 0 talus-tin $source -o named.ply --crs none --overwrite
  expect 0 talus-tin $source -o named.ply --crs EPSG:32632 --t-srs EPSG:25833 --overwrite
done
expect 1 talus-tin without.geojson -o bad.ply
says "(a GeoJSON without crs says so), but the coordinates are not degrees"
printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[500000,5200000,138]}}]}' >spot.geojson
expect 0 talus-tin map.geojson -o spot.ply --spots spot.geojson
says "spot.geojson: taken to be in the CRS of the map: its coordinates are not degrees"

# no CRS
ogr2ogr -q none.shp map.geojson
rm -f none.prj
expect 1 talus-tin none.shp -o bad.ply
says "there is no CRS"
says "hint: name it with --crs EPSG:code, or --crs none for local metres"
expect 0 talus-tin none.shp -o given.ply --crs EPSG:32632
grep -qa '^comment crs' given.ply || fail "the CRS given does not stand in the file"
expect 0 talus-tin none.shp -o local.ply --crs none
if grep -qa '^comment crs' local.ply; then fail "local metres have a CRS in the file"; fi
expect 1 talus-tin map.geojson -o bad.ply --crs EPSG:31287
says "the CRS is EPSG:32632 (WGS 84 / UTM zone 32N), not EPSG:31287"
expect 2 talus-tin map.geojson -o bad.ply --crs EPSG:nonsense
says "is not a CRS"
nothing_left bad.ply
