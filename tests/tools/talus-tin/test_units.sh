# Drawings say their unit in the header: what is not metres is refused, and scaled when asked for.
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
  says "hint: --unit-m $4 scales plan and heights"
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
# inches are what GDAL and QGIS write into every drawing: said, and taken as metres
cone 25832 1 650000 5200000 >map.geojson
ogr2ogr -q -f GPKG map.gpkg map.geojson
ogr2ogr -q -f DXF gdal.dxf map.gpkg -dialect sqlite -sql "SELECT geom FROM map"
expect 0 talus-tin gdal.dxf -o gdal.ply --crs EPSG:25832 --report gdal.json --no-db
says "the header says inches (\$INSUNITS 1), which GDAL and QGIS write whatever the unit is; taken as metres"
[ "$(value gdal.json n_triangles)" = "$(value right.json n_triangles)" ] || fail "a drawing by GDAL gives other triangles"

# plan and CRS in feet: only the heights are in doubt
drawing 2 1 1300000 1000000 >oregon.dxf
expect 1 talus-tin oregon.dxf -o bad.ply --crs EPSG:2994 --t-srs EPSG:32610 --no-db
says "as EPSG:2994 (NAD83(HARN) / Oregon GIC Lambert (ft)) is: are its heights, too?"
says "hint: --elevation-unit-m 0.3048"
# breaklines and spot heights in a drawing of their own
printf '0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n2\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nPOINT\n8\nS\n10\n2132545.931758530\n20\n17060367.454068241\n30\n452.755905511811\n0\nENDSEC\n0\nEOF\n' >spot.dxf
expect 1 talus-tin metres.dxf -o bad.ply --crs EPSG:25832 --spots spot.dxf --no-db
says "hint: --spots-unit-m 0.3048"
expect 0 talus-tin metres.dxf -o spot.ply --crs EPSG:25832 --spots spot.dxf --spots-unit-m 0.3048 --report spot.json --no-db
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
