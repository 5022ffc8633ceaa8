# Drawings say their unit in the header: units other than metres are refused, and scaled when asked
# for.
. "$source_dir/tests/tools/talus-tin/map.sh"
# drawing CODE SCALE [X0 Y0]: the cone as a DXF drawing, coordinates and heights times SCALE
drawing() {
  printf '0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n'
  [ -z "$1" ] || printf '9\n$INSUNITS\n70\n%s\n' "$1"
  printf '0\nENDSEC\n0\nSECTION\n2\nENTITIES\n'
  awk -v s="$2" -v x0="${3-650000}" -v y0="${4-5200000}" 'BEGIN {
    for (ring = 0; ring < 4; ++ring) {
      printf "0\nLWPOLYLINE\n100\nAcDbEntity\n8\nC\n100\nAcDbPolyline\n90\n25\n70\n0\n38\n%.9f\n", (100 + 10 * ring) * s
      for (i = 0; i <= 24; ++i)
        printf "10\n%.9f\n20\n%.9f\n", (x0 + (100 - 20 * ring) * cos(i % 24 * 3.14159265 / 12)) * s, (y0 + (100 - 20 * ring) * sin(i % 24 * 3.14159265 / 12)) * s
    }
  }'
  printf '0\nENDSEC\n0\nEOF\n'
}
drawing 6 1 >metres.dxf
drawing "" 1 >unsaid.dxf
expect 0 talus-tin metres.dxf -o right.ply --crs EPSG:25832 --report right.json --no-db
expect 0 talus-tin unsaid.dxf -o unsaid.ply --crs EPSG:25832 --no-db
cmp right.ply unsaid.ply || fail "without a unit the drawing is in metres"

# unit CODE SCALE NAME METRES: refused, and scaled by the option that the hint names
unit() {
  drawing "$1" "$2" >unit.dxf
  expect 1 talus-tin unit.dxf -o bad.ply --crs EPSG:25832 --no-db
  says "the drawing is in $3 (\$INSUNITS $1 in its header), expected metres"
  says "hint: as $3: --unit-m $4, for plan and heights; as metres: --unit-m 1"
  nothing_left bad.ply
  expect 0 talus-tin unit.dxf -o unit.ply --crs EPSG:25832 --unit-m "$4" --report unit.json --overwrite --no-db
  for key in n_triangles lowest_m highest_m; do
    awk -v a="$(value right.json $key)" -v b="$(value unit.json $key)" 'BEGIN { exit !((a - b) ^ 2 < 1e-6) }' ||
      fail "$3: $key is $(value unit.json $key), expected $(value right.json $key)"
  done
  awk -v a="$(value right.json area_m2)" -v b="$(value unit.json area_m2)" 'BEGIN { exit !((a - b) ^ 2 < 1) }' ||
    fail "$3: area $(value unit.json area_m2), expected $(value right.json area_m2)"
}
unit 2 3.280839895013123 feet 0.3048
unit 4 1000 millimetres 0.001
unit 5 100 centimetres 0.01
unit 21 3.280833333333333 "US survey feet" 0.3048006096012192
# packed it says its unit, too
drawing 2 3.280839895013123 >feet.dxf
gzip -k feet.dxf
python3 -c 'import zipfile; zipfile.ZipFile("feet.zip", "w").write("feet.dxf")'
for packed in feet.dxf.gz feet.zip; do
  expect 1 talus-tin $packed -o bad.ply --crs EPSG:25832 --no-db
  says "the drawing is in feet (\$INSUNITS 2 in its header), expected metres"
  nothing_left bad.ply
  expect 0 talus-tin $packed -o feet.ply --crs EPSG:25832 --unit-m 0.3048 --report feet.json --overwrite --no-db
  says "in units of 0.3048 m"
  grep -q '"elevation_unit_m": 0.3048' feet.json || fail "$packed: layers_read says another unit"
done
# in millimetres by a template, drawn in metres: the user's word counts
drawing 4 1 >template.dxf
expect 0 talus-tin template.dxf -o template.ply --crs EPSG:25832 --unit-m 1 --no-db
cmp right.ply template.ply || fail "--unit-m 1 scales"
# local metres have units too
drawing 4 1000 0 0 >local.dxf
expect 1 talus-tin local.dxf -o bad.ply --crs none --no-db
says "the drawing is in millimetres"
# GDAL and QGIS write inches into every drawing: said, and taken as metres
cone 25832 1 650000 5200000 >map.geojson
ogr2ogr -q -f GPKG map.gpkg map.geojson
ogr2ogr -q -f DXF gdal.dxf map.gpkg -dialect sqlite -sql "SELECT geom FROM map"
expect 0 talus-tin gdal.dxf -o gdal.ply --crs EPSG:25832 --report gdal.json --no-db
says "the header says inches (\$INSUNITS 1), which GDAL and QGIS write whatever the unit is; taken as metres"
[ "$(value gdal.json n_triangles)" = "$(value right.json n_triangles)" ] || fail "a drawing by GDAL gives other triangles"

# plan and CRS in feet: only the heights are in doubt
drawing 2 1 1300000 1000000 >oregon.dxf
expect 1 talus-tin oregon.dxf -o bad.ply --crs EPSG:2994 --t-srs EPSG:32610 --no-db
says "oregon.dxf: the plan is in units of 0.3048 m, and nothing says what unit the heights are in"
says "in that unit the heights go from 30.48 to 39.624 m, 9.144 m over"
says "in metres the heights go from 100 to 130 m, 30 m over"
says "hint: in that unit: --elevation-unit-m 0.3048; in metres: --elevation-unit-m 1"

# the same plan in other formats, for contours, points, breaklines and spot heights
command -v gdaltransform >/dev/null || skip "needs gdal-bin"
nothing_said() {
  expect 1 talus-tin "$@" -o bad.ply --no-db
  says "m, and nothing says what unit the heights are in"
  nothing_left bad.ply
}
# highest FILE METRES: of a report, within a millimetre
highest() {
  awk -v z="$(value "$1" highest_m)" -v expected="$2" 'BEGIN { exit !((z - expected) ^ 2 < 1e-6) }' ||
    fail "$1: up to $(value "$1" highest_m) m, expected $2"
}
cone 26912 1 450000 4400000 >utah.geojson
ogr2ogr -q -t_srs EPSG:3566 utah.gpkg utah.geojson
nothing_said utah.gpkg --t-srs EPSG:26912
says "hint: in that unit: --elevation-unit-m 0.304800609601;"
expect 0 talus-tin utah.gpkg -o m.ply --t-srs EPSG:26912 --elevation-unit-m 1 --report m.json --no-db
highest m.json 130
expect 0 talus-tin utah.gpkg -o ft.ply --t-srs EPSG:26912 --elevation-unit-m 0.304800609601 --report ft.json --no-db
highest ft.json 39.624079248
# without --t-srs the plan is in doubt first, and the hint says nothing of heights
expect 1 talus-tin utah.gpkg -o bad.ply --no-db
says "in US survey foot of 0.3048006096 m, expected a projected one in metres"
grep -q '^  hint: --t-srs EPSG:26912 reprojects$' err || fail "the hint guesses: $(cat err)"
# a system of heights says the unit, in feet of its own and in metres
ogr2ogr -q -a_srs EPSG:3566+6360 in_feet.gpkg utah.gpkg
ogr2ogr -q -a_srs EPSG:3566+5703 in_metres.gpkg utah.gpkg
ogr2ogr -q -a_srs EPSG:26912+6360 utm_feet.gpkg utah.geojson
expect 0 talus-tin in_feet.gpkg -o ft.ply --t-srs EPSG:26912 --report ft.json --overwrite --no-db
says "in_feet.gpkg: heights in EPSG:6360 (NAVD88 height (ftUS)), taken to metres"
highest ft.json 39.624079248
expect 0 talus-tin in_metres.gpkg -o m.ply --t-srs EPSG:26912 --report m.json --overwrite --no-db
highest m.json 130
expect 0 talus-tin utm_feet.gpkg -o ft.ply --report ft.json --overwrite --no-db
highest ft.json 39.624079248
# the user's word for a system in metres
expect 0 talus-tin utah.gpkg -o m.ply --t-srs EPSG:26912 --vertical-crs EPSG:5703 --report m.json --overwrite --no-db
highest m.json 130
# points of the ground
ogr2ogr -q -a_srs EPSG:3566 ground.gpkg utah.gpkg -dialect sqlite -sql "SELECT ST_DissolvePoints(geom) AS geom FROM utah" -explodecollections
nothing_said ground.gpkg --points --t-srs EPSG:26912
expect 0 talus-tin ground.gpkg -o p.ply --points --t-srs EPSG:26912 --elevation-unit-m 0.304800609601 --no-db
# breaklines and spot heights beside contours in metres
ogr2ogr -q spots.gpkg ground.gpkg -where "FID < 5"
for extra in "--breaklines utah.gpkg" "--spots spots.gpkg"; do
  nothing_said utah.geojson $extra
  expect 0 talus-tin utah.geojson $extra -o m.ply --elevation-unit-m 1 --overwrite --no-db
done
printf 'x,y,z\n450000,4400000,452.7559055\n' >peak.csv
ogr2ogr -q -a_srs EPSG:26912+8228 peak.gpkg peak.csv -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z
expect 0 talus-tin utah.geojson --spots peak.gpkg -o peak.ply --no-db
says "peak.gpkg: heights in EPSG:8228 (NAVD88 height (ft)), taken to metres"
expect 0 talus-trn peak.ply -o peak.tif --cell-size-m 1 --no-db
awk -v z="$(gdallocationinfo -valonly -geoloc peak.tif 450000 4400000)" 'BEGIN { exit !((z - 138) ^ 2 < 1e-4) }' ||
  fail "the spot height is $(gdallocationinfo -valonly -geoloc peak.tif 450000 4400000) m, expected 138"

# breaklines and spot heights in a drawing of their own
printf '0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n2\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nPOINT\n8\nS\n10\n2132545.931758530\n20\n17060367.454068241\n30\n452.755905511811\n0\nENDSEC\n0\nEOF\n' >spot.dxf
expect 1 talus-tin metres.dxf -o bad.ply --crs EPSG:25832 --spots spot.dxf --no-db
says "hint: as feet: --unit-m spots=0.3048"
expect 0 talus-tin metres.dxf -o spot.ply --crs EPSG:25832 --spots spot.dxf --unit-m spots=0.3048 --report spot.json --no-db
[ "$(value spot.json n_spots)" = 1 ] || fail "no spot height"
expect 0 talus-trn spot.ply -o spot.tif --cell-size-m 1 --no-db
awk -v z="$(gdallocationinfo -valonly -geoloc spot.tif 650000 5200000)" 'BEGIN { exit !((z - 138) ^ 2 < 0.01) }' ||
  fail "the spot height is $(gdallocationinfo -valonly -geoloc spot.tif 650000 5200000) m, expected 138"
# a drawing in an archive
if command -v zip >/dev/null; then
  drawing 2 3.280839895013123 >feet.dxf
  zip -q feet.zip feet.dxf
  expect 1 talus-tin /vsizip/feet.zip/feet.dxf -o bad.ply --crs EPSG:25832 --no-db
  says "the drawing is in feet"
fi
expect 2 talus-tin metres.dxf -o bad.ply --crs EPSG:25832 --unit-m 0 --no-db
nothing_left bad.ply
