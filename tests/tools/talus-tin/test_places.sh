# Coordinates that contradict their CRS are refused with the likely system; the commands
# of the hints give the triangles of the right map.
. "$source_dir/tests/tools/talus-tin/map.sh"
cone 25832 1 650000 5200000 >map.geojson
expect 0 talus-tin map.geojson -o right.ply --report right.json --no-db
data right.ply >expected
if grep -q warning err; then fail "a map in its place is warned of"; fi
# refused FILE FINDING: and nothing is left
refused() {
  expect 1 talus-tin "$1" -o bad.ply --no-db
  says "$2"
  nothing_left bad.ply
}
# hint: the last one, as a command
run_hint() { sed -n 's/^ *hint: //p' err >hint.sh && sh -e hint.sh >/dev/null; }
# same_triangles FILE: as many, and the area within 1 m2 of 31416
same_triangles() {
  [ "$(value "$1" n_triangles)" = "$(value right.json n_triangles)" ] || fail "$1: other triangles"
  awk -v a="$(value right.json area_m2)" -v b="$(value "$1" area_m2)" 'BEGIN { exit !((a - b) ^ 2 < 1) }' ||
    fail "$1: area $(value "$1" area_m2), expected $(value right.json area_m2)"
}

# x and y exchanged, in two formats
ogr2ogr -q -f GPKG -nln exchanged exchanged.gpkg map.geojson -dialect sqlite -sql 'SELECT SwapCoords(geometry) AS geometry, * FROM "map"' -a_srs EPSG:25832
ogr2ogr -q -lco SHPT=ARCZ exchanged.shp exchanged.gpkg
for file in exchanged.gpkg exchanged.shp; do
  refused $file "with x and y exchanged they would lie in it"
  rm -f mended.gpkg
  run_hint
  expect 0 talus-tin mended.gpkg -o back.ply --report back.json --overwrite --no-db
  same_triangles back.json
done

# degrees under a CRS in metres
ogr2ogr -q -t_srs EPSG:4326 degrees.gpkg map.geojson
ogr2ogr -q -a_srs EPSG:25832 lying.gpkg degrees.gpkg
refused lying.gpkg "they look like degrees"
says "hint: --crs EPSG:4326 --t-srs EPSG:25832"
expect 0 talus-tin lying.gpkg -o back.ply --crs EPSG:4326 --t-srs EPSG:25832 --report back.json --overwrite --no-db
says "where its coordinates cannot be; taken as EPSG:4326"
same_triangles back.json
# latitude first, to be reprojected: QGIS 'y x' columns
ogr2ogr -q -f GPKG -nln latitude latitude.gpkg degrees.gpkg -dialect sqlite -sql 'SELECT SwapCoords(geom) AS geom, * FROM "map"' -a_srs EPSG:4326
expect 1 talus-tin latitude.gpkg -o bad.ply --t-srs EPSG:25832 --no-db
says "with x and y exchanged they would lie in it"
nothing_left bad.ply

# the number of the zone before the eastings, and missing there
cone 25832 1 32650000 5200000 >prefix.geojson
refused prefix.geojson "begin with the zone number 32"
expect 0 talus-tin prefix.geojson -o back.ply --crs EPSG:4647 --t-srs EPSG:25832 --report back.json --overwrite --no-db
same_triangles back.json
cone 31467 1 550000 5300000 >short.geojson
# ... which zones of Gauss and Krueger and of UTM do alike: the hint asks for the CRS
refused short.geojson "lack the zone number 3"
says "hint: is it the CRS of these coordinates? name the right one with --crs EPSG:code"
expect 0 talus-tin short.geojson -o back.ply --crs EPSG:25832 --report back.json --overwrite --no-db
same_triangles back.json
# the number of a zone of another projection
cone 25832 1 3550000 5300000 >other.geojson
refused other.geojson "as eastings of zone 3 of Gauss and Krueger (meridian 9 E) they would lie in it"
says "hint: is it the CRS of these coordinates? name the right one with --crs EPSG:code"
expect 0 talus-tin other.geojson -o back.ply --crs EPSG:31467 --report back.json --overwrite --no-db
same_triangles back.json

# feet without a word of it; the hint
cone 25832 3.280839895013123 2132545.931758530 17060367.454068241 >feet.geojson
refused feet.geojson "as feet they would lie in it"
says "hint: --unit-m 0.3048"
expect 0 talus-tin feet.geojson -o back.ply --unit-m 0.3048 --elevation-unit-m 1 --report back.json --overwrite --no-db
same_triangles back.json

# stretched metres; another continent
cone 3857 1 1220000 5940000 >mercator.geojson
refused mercator.geojson "whose metres are stretched here"
says "--t-srs EPSG:32632"
expect 0 talus-tin mercator.geojson -o back.ply --t-srs EPSG:32632 --report back.json --overwrite --no-db
awk -v a="$(value right.json area_m2)" -v b="$(value back.json area_m2)" 'BEGIN { s = a / b; exit !(s > 2.1 && s < 2.25) }' ||
  fail "1 m2 of Mercator at 47 degrees is 0.46 m2, not $(value back.json area_m2) of $(value right.json area_m2)"
cone 2193 1 650000 5200000 >far.geojson
refused far.geojson "lie outside the area that EPSG:2193"
says "name the right one with --crs EPSG:code"
expect 0 talus-tin far.geojson -o back.ply --crs EPSG:25832 --overwrite --no-db
data back.ply >found
cmp -s expected found || fail "with --crs other triangles"
# a CRS that can be true is not replaced
expect 1 talus-tin map.geojson -o bad.ply --crs EPSG:25833 --no-db
says "leave --crs away"

# spot heights that lie elsewhere
printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:25832"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[5200000,650000,138]}}]}' >spot.geojson
expect 1 talus-tin map.geojson -o bad.ply --spots spot.geojson --no-db
says "spot.geojson: its coordinates"
says "with x and y exchanged"
nothing_left bad.ply

# a datum that is not known: of a PROJ string, and of a .prj
cone "" 1 80000 236000 >bare.geojson
bessel="+proj=tmerc +lat_0=0 +lon_0=10.3333333333333 +k=1 +x_0=0 +y_0=-5000000 +ellps=bessel +units=m"
ogr2ogr -q -a_srs "$bessel" bessel.gpkg bare.geojson
ogr2ogr -q -lco SHPT=ARCZ -a_srs "$bessel" bessel.shp bare.geojson
truth=$(echo "80100 236000" | gdaltransform -s_srs EPSG:31254 -t_srs EPSG:25832 -output_xy)
for file in bessel.gpkg bessel.shp; do
  expect 1 talus-tin $file -o bad.ply --t-srs EPSG:25832 --no-db
  says "PROJ knows no shift of the datum"
  says "hint: name the CRS that is meant with --crs EPSG:code; --accept-ballpark"
  nothing_left bad.ply
  expect 0 talus-tin $file -o named.ply --crs EPSG:31254 --t-srs EPSG:25832 --report named.json --overwrite --no-db
  says "whose datum is not known; taken as EPSG:31254"
  says "reprojected from EPSG:31254 (MGI / Austria GK West) to EPSG:25832 (ETRS89 / UTM zone 32N) by"
  grep -q '"operations"' named.json || fail "the operation does not stand in the report"
  expect 0 talus-tin $file -o guessed.ply --t-srs EPSG:25832 --accept-ballpark --overwrite --no-db
  says "the place may be off by a hundred metres"
done
expect 0 talus-trn named.ply -o named.tif --cell-size-m 5 --no-db
expect 0 talus-trn guessed.ply -o guessed.tif --cell-size-m 5 --no-db
# the eastern end of the lowest ring is known at the place that it has
east=${truth% *} north=${truth#* }
known() { gdallocationinfo -valonly -geoloc "$1" "$(awk -v x="$east" 'BEGIN { print x - 6 }')" "$north" | awk '{ exit !($1 > 90) }'; }
known named.tif || fail "named by --crs it does not reach $truth"
corner() { gdalinfo "$1" | sed -n 's/^Upper Left *( *\([0-9.]*\), *\([0-9.]*\)).*/\1 \2/p'; }
echo "$(corner named.tif) $(corner guessed.tif)" | awk '{ exit !(($1 - $3) ^ 2 + ($2 - $4) ^ 2 > 50 ^ 2) }' ||
  fail "the guess lies where the truth does: $(corner named.tif), $(corner guessed.tif)"
# kept for the report
expect 0 talus-tin bessel.gpkg -o kept.ply --crs EPSG:31254 --t-srs EPSG:25832
talus-runs show 1 >show
grep -q "reprojected from EPSG:31254" show || fail "the registry does not hold the operation"
