# Heights that do not go with those around them are named; which layers were taken is said.
. "$source_dir/tests/tools/talus-tin/map.sh"
slope() { # slope N HEIGHT: contours every 10 m from 1000 m on, 20 m apart; the N-th has HEIGHT
  set -- "$1" "$2"
  awk -v wrong="$1" -v height="$2" 'BEGIN {
    print "{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:25832\"}},\"features\":["
    for (l = 0; l <= 10; ++l) {
      printf "%s{\"type\":\"Feature\",\"properties\":{\"ELEV\":%s},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[", l ? ",\n" : "", l == wrong ? height : 1000 + 10 * l
      for (i = 0; i <= 10; ++i) printf "%s[%d,%d]", i ? "," : "", 650000 + 20 * i, 5200000 + 20 * l
      printf "]}}"
    }
    print "]}"
  }'
}
spots() { # spots X Y Z ...
  printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:25832"}},"features":['
  comma=
  while [ $# -gt 0 ]; do
    printf '%s{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[%s,%s,%s]}}' "$comma" "$1" "$2" "$3"
    comma=,
    shift 3
  done
  printf ']}\n'
}
slope -1 0 >right.geojson
expect 0 talus-tin right.geojson -o right.ply --report right.json
! grep -q warning err || fail "a right map is doubted"
grep -q '"doubts": \[\]' right.json || fail "the report does not say that nothing is in doubt"

# 1150 m may be; 0 m, a kilometre below a point 20 m beside it, cannot
slope 5 0 >zero.geojson
expect 1 talus-tin zero.geojson -o bad.ply --doubts places.gpkg
says "zero.geojson: contour at 0 m, feature 5, x 650"
says "hint: mend it in the map, or go on with --accept-doubts (make TIN_FLAGS=--accept-doubts)"
nothing_left bad.ply
python3 "$source_dir/tests/tools/fields.py" "$source_dir/docs/reference/fields.md" places.gpkg || fail "fields"
ogr2ogr -q -f CSV places.csv places.gpkg doubts -lco GEOMETRY=AS_XY
grep -q '650[0-9]*,5200100,contour,zero.geojson,"*5"*,.*,0,1040,1060,refused' places.csv || fail "$(cat places.csv)"
slope 5 -600 >deep.geojson
expect 1 talus-tin deep.geojson -o bad.ply
says "contour at -600 m, feature 5, x 650000, y 5200100: expected -500 m or more: no land lies lower"
for height in 1150 0; do
  slope 5 $height >wrong.geojson
  expect 0 talus-tin wrong.geojson -o wrong.ply --overwrite --report wrong.json --json --accept-doubts \
    --doubts places.gpkg
  [ "$(ogrinfo -so places.gpkg doubts | grep 'Feature Count')" = "Feature Count: 1" ] || fail "one place expected"
  says "warning: wrong.geojson: contour at $height m, feature 5, x 650"
  says "y 5200100: expected 1040 to 1060 m, as beside it"
  grep -q '"n_doubts"' out || fail "the result does not hold the doubt"
  python3 - $height <<'PY' || fail 'doubts'
import json, sys
report = json.load(open('wrong.json'))
row, = report['doubts']
assert report['n_doubts'] == {'contour': 1} and row['state'] == {'1150': 'in doubt', '0': 'accepted'}[sys.argv[1]], row
assert row['what'] == 'contour' and row['feature'] == 5 and row['value'] == float(sys.argv[1]), row
assert [row['low'], row['high']] == [1040, 1060] and row['at'][0][1] == 5200100, row
PY
done
for height in -9999 -32767 -32768; do
  slope 5 $height >nothing.geojson
  expect 1 talus-tin nothing.geojson -o bad.ply
  says "feature 5 (650000, 5200100): the elevation is $height, which stands for an unknown one"
  nothing_left bad.ply
done
rm -f known.gpkg
sh -c "$(sed -n 's/^ *hint: .*take such out: //p' err)"
expect 0 talus-tin known.gpkg -o known.ply

# spot heights: right ones pass, one in feet and one of 0 are named; a spot without a value is refused
spots 650050 5200092 1046 650150 5200030 1015 >good.geojson
expect 0 talus-tin right.geojson --spots good.geojson -o good.ply
says "good.geojson: layer good, 2 features"
! grep -q warning err || fail "right spot heights are doubted"
spots 650050 5200092 3431.8 650150 5200030 1015 650110 5200130 1064 >feet.geojson
expect 1 talus-tin right.geojson --spots feet.geojson -o feet.ply
nothing_left feet.ply
expect 0 talus-tin right.geojson --spots feet.geojson -o feet.ply --accept-doubts
says "warning: feet.geojson: spot height at 3431.8 m, x 650050, y 5200092: expected 1040 to 1050 m"
spots 650050 5200092 -9999 650150 5200030 1015 >unknown.geojson
expect 1 talus-tin right.geojson --spots unknown.geojson -o bad.ply
says "unknown.geojson: layer unknown, feature 0 (650050, 5200092): the elevation is -9999"

spots 650050 5200092 1300 650150 5200030 1015 >high.geojson
expect 1 talus-tin right.geojson --spots high.geojson -o bad.ply
spots 650050 5200092 1120 650150 5200030 1015 >doubtful.geojson
expect 0 talus-tin right.geojson --spots doubtful.geojson -o doubtful.ply
says "warning: doubtful.geojson: spot height at 1120 m"

# the systems of heights: carried on, not changed
ogr2ogr -q -a_srs EPSG:25832+5773 egm96.gpkg right.geojson
expect 0 talus-tin egm96.gpkg -o egm96.ply --t-srs EPSG:25833 --spots good.geojson
says "good.geojson and the map: both are taken to have heights in EPSG:5773 (EGM96 height)"
grep -qa "EGM96 height" egm96.ply || fail "the system of heights was lost"
expect 1 talus-tin right.geojson -o bad.ply --t-srs EPSG:25833+5773
says "would have them in EPSG:5773 (EGM96 height)"
ogr2ogr -q -a_srs EPSG:25832+7837 dhhn.gpkg good.geojson
expect 1 talus-tin egm96.gpkg -o bad.ply --spots dhhn.gpkg
says "the heights are in EPSG:7837 (DHHN2016 height), those of the map in EPSG:5773 (EGM96 height)"
