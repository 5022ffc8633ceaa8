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
says "1 of 1 heights lie far from the contours"
says "as feet the heights go from 138.0744 to 138.0744 m"
point 500100 5200000 109 >off.geojson
expect 1 talus-tin map.geojson -o bad.ply --spots off.geojson
says "meeting spot height at 109 m, x 500100, y 5200000: meets contour at 100 m"

# a ridge line crosses contours; where it is near enough it takes their height
lines "0:500000,5200000;500100,5200000" | sed 's/\[500000,5200000\]/[500000,5200000,149]/; s/\[500100,5200000\]/[500100,5200000,100]/' >ridge.geojson
expect 0 talus-tin map.geojson -o ridge.ply --breaklines ridge.geojson --report ridge.json
[ "$(value ridge.json breaklines_and_spots_on_contours)" -ge 4 ] || fail "the ridge meets no contour"
lines "0:500000,5200000;500100,5200000" | sed 's/"ELEV":0/"NAME":1/' >flat_ridge.geojson
expect 1 talus-tin map.geojson -o bad.ply --breaklines flat_ridge.geojson
says "the breaklines have no elevation: they are 2-D and no field has a known name"
says "hint: name the field with --elevation-field breaklines=FIELD"

# a Z of 0 everywhere is not a height: a field holds it, or nothing does; Z that tells heights stays
spots() { # spots FIELD HEIGHT Z: one spot height on the summit, one beside it
  printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":['
  printf '{"type":"Feature","properties":{"%s":%s},"geometry":{"type":"Point","coordinates":[500000,5200000,%s]}},' "$@"
  printf '{"type":"Feature","properties":{"%s":%s},"geometry":{"type":"Point","coordinates":[500003,5200000,%s]}}]}' "$@"
}
spots ELEV 138 138 >level_spots.geojson
spots ELEV 138 0 >zero_spots.geojson
spots ELEV null 138 >null_spots.geojson
spots hoehe_nn 138 0 >named_spots.geojson
expect 0 talus-tin map.geojson -o level_spots.ply --spots level_spots.geojson
data level_spots.ply >expected
for spots in zero_spots.geojson null_spots.geojson "named_spots.geojson --elevation-field spots=hoehe_nn"; do
  expect 0 talus-tin map.geojson -o spots.ply --spots $spots --overwrite
  data spots.ply >found
  cmp -s expected found || fail "--spots $spots gives another terrain"
done
says "named_spots.geojson: elevation from field hoehe_nn"
expect 1 talus-tin map.geojson -o bad.ply --spots named_spots.geojson
says "the spot heights have no elevation: all Z are 0 and no field has a known name"
says "hint: name the field with --elevation-field spots=FIELD; the fields are: hoehe_nn; or Z where 0 m is meant"
lines "138:500000,5200000;500010,5200000" | sed 's/\(\[5000[01]0,5200000\)\]/\1,0]/g' >zero_ridge.geojson
lines "0:500000,5200000;500010,5200000" | sed 's/\(\[5000[01]0,5200000\)\]/\1,138]/g' >ridge_z.geojson
expect 0 talus-tin map.geojson -o ridge_z.ply --breaklines ridge_z.geojson
expect 0 talus-tin map.geojson -o zero_ridge.ply --breaklines zero_ridge.geojson
says "zero_ridge.geojson: elevation from field ELEV"
data ridge_z.ply >expected
data zero_ridge.ply >found
cmp -s expected found || fail "a breakline with Z 0 and a field gives another terrain"

# the same for points that a terrain is held against; their layer can be named
ogr2ogr -q -nln heights two_layers.gpkg named_spots.geojson
ogr2ogr -q -nln others -update two_layers.gpkg spot.geojson
expect 1 talus-trn spots.ply -o bad.tif --reference-points two_layers.gpkg
says "hint: put \"|layername="
expect 0 talus-trn spots.ply -o spots.tif --window 499990,5199990,500010,5200010 --cell-size-m 1 --report spots_trn.json \
  --reference-points 'two_layers.gpkg|layername=heights' --elevation-field hoehe_nn
[ "$(value spots_trn.json largest_m)" = 0.0 ] || fail "the spot heights are off by $(value spots_trn.json largest_m) m"

# the boundary cuts; a hole stays a hole; elsewhere leaves nothing
polygon() { printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[%s]}}]}' "$1"; }
polygon '[[499900,5199900],[500000,5199900],[500000,5200100],[499900,5200100],[499900,5199900]]' >west.geojson
expect 0 talus-tin map.geojson -o west.ply --boundary west.geojson --report west.json
area() { sed -n 's/^  "area_m2": \([0-9.]*\).*/\1/p' "$1"; }
awk -v a="$(area plain.json)" -v b="$(area west.json)" 'BEGIN { exit !(b > 0.45 * a && b < 0.55 * a) }' ||
  fail "the western half has $(area west.json) m2 of $(area plain.json)"
square() { printf '[[[499900,5199900],[%s,5199900],[%s,5200100],[499900,5200100],[499900,5199900]]]' "$1" "$1"; }
polygon "]$(square 500000),$(square 499950)[" | sed 's/"Polygon","coordinates":\[\]/"MultiPolygon","coordinates":[/; s/\[\]}/]}/' >overlap.geojson
expect 0 talus-tin map.geojson -o overlap.ply --boundary overlap.geojson
cmp -s west.ply overlap.ply || fail "where polygons of a boundary overlap is a hole"
says "overlap.geojson: the boundary reaches beyond the data: 19.8 % of its 2 ha is missing"
polygon '[[499950,5199950],[500050,5199950],[500050,5200050],[499950,5200050],[499950,5199950]]' >inside.geojson
expect 0 talus-tin map.geojson -o inside.ply --boundary inside.geojson
! grep -q 'reaches beyond' err || fail "$(cat err)"
polygon '[[499900,5199900],[500100,5200100],[500100,5199900],[499900,5200100],[499900,5199900]]' >bow.geojson
expect 1 talus-tin map.geojson -o bad.ply --boundary bow.geojson
says "bow.geojson: polygon 1 of the boundary crosses itself at x 500000, y 5200000"
polygon '[[1,1],[2,1],[2,2],[1,1]]' >elsewhere.geojson
expect 1 talus-tin map.geojson -o bad.ply --boundary elsewhere.geojson
says "the boundary and the contours share no ground"
expect 1 talus-tin map.geojson -o bad.ply --boundary ridge.geojson
says "holds no polygons, but 1 open line; expected polygons or closed lines"
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
says "hint: put \"|layername="
expect 0 talus-tin 'both.gpkg|layername=old_contours' -o chosen.ply
