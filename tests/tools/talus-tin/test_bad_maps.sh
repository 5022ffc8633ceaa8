# Maps that make no terrain are refused with place, finding and a remedy, and leave nothing behind.
. "$source_dir/tests/tools/talus-tin/map.sh"
cone >map.geojson
ogr2ogr -q map.gpkg map.geojson
refused() { # refused WORDS COMMAND...
  words=$1
  shift
  expect 1 "$@" -o bad.ply --report bad.json
  says "$words"
  nothing_left bad.ply bad.json
}

refused "there is no layer \"contors\"; there are: map" talus-tin 'map.gpkg|layername=contors'
ogr2ogr -q -where "ELEV > 9999" empty.gpkg map.geojson
refused "the layer is empty, expected lines" talus-tin empty.gpkg
ogr2ogr -q -dim XY -select NAME nofield.gpkg map.geojson
refused "the contours have no elevation: they are 2-D and no field has a known name" talus-tin nofield.gpkg
says "hint: name the field with --elevation-field FIELD; the fields are: NAME"
refused "there is no field \"HEIHGT\"; the fields are: ELEV, NAME" talus-tin map.gpkg --elevation-field HEIHGT
refused "the field NAME says \"ring 0\", expected an elevation" talus-tin map.gpkg --elevation-field NAME
says "layer map, feature 1"
lines "100:500000,5200000;500100,5200000" "null:500000,5200100;500100,5200100" >null_field.geojson
refused "the field ELEV is empty" talus-tin null_field.geojson
ogr2ogr -q -where "ELEV = 110" one.gpkg map.geojson
refused "there is one contour only, at 110 m, expected contours at two heights at least" talus-tin one.gpkg
lines "100:500000,5200000;500100,5200000" "100:500000,5200100;500100,5200100" >level.geojson
refused "all contours stand at one height, 100 m" talus-tin level.geojson
lines "100:500000,5200000;500100,5200000" "110:500200,5200000;500300,5200000" >straight.geojson
refused "all points stand on one straight line" talus-tin straight.geojson
refused "cannot be opened as vectors" talus-tin "$source_dir/LICENSE"

# crossing and touching contours: the place and both heights
lines "100:500000,5200000;500100,5200100" "110:500000,5200100;500100,5200000" >crossing.geojson
refused "contour at 100 m, feature 0, x 500050, y 5200050: meets contour at 110 m" talus-tin crossing.geojson
lines "100:500000,5200000;500100,5200000" "110:500050,5200000;500050,5200100" >touching.geojson
refused "x 500050, y 5200000: meets contour at 110 m" talus-tin touching.geojson

# coordinates that are not numbers: the second point's y in a shapefile of plain lines
lines "100:500000,5200000;500100,5200000" "110:500000,5200100;500100,5200100" >plain.geojson
ogr2ogr -q plain.shp plain.geojson
for bits in '\370\177' '\360\177' '\360\377'; do # nan, inf, -inf
  printf "\\0\\0\\0\\0\\0\\0$bits" | dd of=plain.shp bs=1 seek=180 conv=notrunc 2>/dev/null
  refused "a coordinate is not finite" talus-tin plain.shp
  says "layer plain, feature 0"
done

# lines that change their height are not contours; polygons and points are not lines
sed '3s/,110\]/,111]/' map.geojson >sloping.geojson
refused "changes its height along the line, expected contours" talus-tin sloping.geojson
printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[{"type":"Feature","properties":{"ELEV":1},"geometry":{"type":"Point","coordinates":[1,2]}}]}' >points.geojson
refused "holds no lines, but 1 point; expected lines" talus-tin points.geojson

# mixed units: Z in metres, a field in feet
sed 's/"ELEV":1\([0-3]\)0/"ELEV":3\100/' map.geojson >mixed.geojson
refused "has Z 100 and ELEV 3000, expected the same height: mixed units?" talus-tin mixed.geojson
expect 0 talus-tin mixed.geojson -o z.ply --elevation-field Z
ogr2ogr -q -dim XY -sql "SELECT ELEV AS ELEV_FT FROM map" feet.gpkg map.geojson
refused "the field ELEV_FT is in feet by its name" talus-tin feet.gpkg
says "hint: as feet: --elevation-unit-m 0.3048"
expect 0 talus-tin feet.gpkg -o feet.ply --elevation-unit-m 0.3048 --report feet.json
awk -v v="$(value feet.json interval_m)" 'BEGIN { exit !((v - 3.048) ^ 2 < 1e-18) }' ||
  fail "interval $(value feet.json interval_m), expected 3.048"

# no ground is that high
sed 's/"ELEV":1\([0-3]\)0/"ELEV":13\1000/; s/,1\([0-3]\)0\]/,13\1000]/g' map.geojson >high.geojson
refused "is 130000 m, expected at most 9000 m either way" talus-tin high.geojson
expect 0 talus-tin high.geojson -o millimetres.ply --elevation-unit-m 0.001

# a truncated shapefile reads without complaint: its null geometries are counted
ogr2ogr -q whole.shp map.geojson
head -c 1200 whole.shp >cut.shp
cp whole.shx cut.shx
cp whole.dbf cut.dbf
cp whole.prj cut.prj
refused "of 4 features have no geometry" talus-tin cut.shp
