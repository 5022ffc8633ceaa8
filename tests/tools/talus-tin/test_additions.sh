# Breaklines, spot heights and a boundary: used, reprojected with a note, refused when they contradict.
. "$source_dir/tests/tools/talus-tin/map.sh"
cone >map.geojson
point() { # point X Y Z [EPSG]
  printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:%s"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[%s,%s,%s]}}]}' "${4-32632}" "$1" "$2" "$3"
}
point 500000 5200000 138 >spot.geojson
expect 0 talus-tin map.geojson -o plain.ply --report plain.json
expect 0 talus-tin map.geojson -o spot.ply --spots spot.geojson --report spot.json
[ "$(value spot.json n_spots)" = 1 ] || fail "the spot height was not read"
share() { value "$1" share_before; }
awk -v a="$(share plain.json)" -v b="$(share spot.json)" 'BEGIN { exit !(a > 0.1 && b == 0) }' ||
  fail "the summit is flat ($(share spot.json)) in spite of its spot height"

ogr2ogr -q -t_srs EPSG:25833 far.gpkg spot.geojson
expect 0 talus-tin map.geojson -o far.ply --spots far.gpkg --report far.json
says "far.gpkg: reprojected from EPSG:25833 (ETRS89 / UTM zone 33N) to EPSG:32632 (WGS 84 / UTM zone 32N)"
expect 0 talus-trn far.ply -o far.tif --window 499995,5199995,500005,5200005 --cell-size-m 1 --reference-points spot.geojson --report far_trn.json
awk -v e="$(value far_trn.json largest_m)" 'BEGIN { exit !(e ^ 2 < 0.09) }' || fail "the reprojected spot is off by $(value far_trn.json largest_m) m"

point 500000 5200000 453 >feet_spot.geojson
expect 1 talus-tin map.geojson -o bad.ply --spots feet_spot.geojson
says "mixed units?"
point 500100 5200000 109 >off.geojson
expect 1 talus-tin map.geojson -o bad.ply --spots off.geojson
says "contour at 100 m meets spot height at 109 m at x 500100, y 5200000"

# a ridge line crosses contours; where it is near enough it takes their height
lines "0:500000,5200000;500100,5200000" | sed 's/\[500000,5200000\]/[500000,5200000,149]/; s/\[500100,5200000\]/[500100,5200000,100]/' >ridge.geojson
expect 0 talus-tin map.geojson -o ridge.ply --breaklines ridge.geojson --report ridge.json
[ "$(value ridge.json breaklines_and_spots_on_contours)" -ge 4 ] || fail "the ridge meets no contour"
lines "0:500000,5200000;500100,5200000" | sed 's/"ELEV":0/"NAME":1/' >flat_ridge.geojson
expect 1 talus-tin map.geojson -o bad.ply --breaklines flat_ridge.geojson
says "the breakline has no elevation (2-D), expected Z"

# the boundary cuts; a hole stays a hole; elsewhere leaves nothing
polygon() { printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[%s]}}]}' "$1"; }
polygon '[[499900,5199900],[500000,5199900],[500000,5200100],[499900,5200100],[499900,5199900]]' >west.geojson
expect 0 talus-tin map.geojson -o west.ply --boundary west.geojson --report west.json
awk -v a="$(value plain.json area_m2)" -v b="$(value west.json area_m2)" 'BEGIN { exit !(b > 0.45 * a && b < 0.55 * a) }' ||
  fail "the western half has $(value west.json area_m2) m2 of $(value plain.json area_m2)"
polygon '[[1,1],[2,1],[2,2],[1,1]]' >elsewhere.geojson
expect 1 talus-tin map.geojson -o bad.ply --boundary elsewhere.geojson
says "the boundary and the contours share no ground"
expect 1 talus-tin map.geojson -o bad.ply --boundary map.geojson
says "expected polygons"
nothing_left bad.ply

# layers of one file are told apart by their geometry; two of a kind must be chosen
ogr2ogr -q -nln contours both.gpkg map.geojson
ogr2ogr -q -nln spots -update both.gpkg spot.geojson
expect 0 talus-tin both.gpkg -o both.ply --spots both.gpkg
data both.ply >found
data spot.ply >expected
cmp -s expected found || fail "contours and spots from one file give other triangles"
ogr2ogr -q -nln old_contours -update both.gpkg map.geojson
expect 1 talus-tin both.gpkg -o bad.ply
says "2 layers hold lines, expected one; the layers are: contours, spots, old_contours"
says "hint: choose with --layer"
expect 0 talus-tin both.gpkg -o chosen.ply --layer old_contours
