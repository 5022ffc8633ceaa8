# A TIN becomes nodes: exact on planes, unknown outside of it, the same bytes every time.
awk 'BEGIN {
  print "{\"type\": \"FeatureCollection\", \"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"urn:ogc:def:crs:EPSG::32632\"}}, \"features\": ["
  for (i = 0; i <= 10; ++i) {
    printf "%s{\"type\": \"Feature\", \"properties\": {\"elev\": %d}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": [", (i ? "," : ""), 500 + 10 * i
    for (j = 0; j <= 8; ++j) printf "%s[%d, %d]", (j ? "," : ""), 500000 + 20 * i, 5200000 + 25 * j
    print "]}}"
  }
  print "]}" }' >contours.json
expect 0 talus-tin contours.json -o plane.ply --elevation-field elev

expect 0 talus-trn plane.ply -o plane.tif --cell-size-m 4 --report plane.json
prints "51 x 51 nodes, 4 m apart, 100 % known, 500 to 600 m"
prints "slope 26.6 degrees on average, up to 26.6"
gdal_translate -q -of ENVI plane.tif plane.bin
od -A n -v -w408 -t f8 plane.bin |
  awk '{ for (c = 1; c <= NF; ++c) { e = $c - 500 - 2 * (c - 1); if (e > 1e-9 || e < -1e-9) exit 1 } }
       END { exit NR != 51 }' || fail "a plane did not stay the plane"
gdalinfo plane.tif | grep -qF 'ID["EPSG",32632]' || fail "the CRS of the TIN was lost"

expect 0 talus-trn plane.ply -o twice.tif --cell-size-m 4
cmp plane.tif twice.tif || fail "not byte-identical on repeat"

# beyond the TIN nothing is known; a window without any of it is refused
expect 0 talus-trn plane.ply -o wide.tif --cell-size-m 4 --window 499900,5199900,500300,5200300
prints "101 x 101 nodes, 4 m apart, 25.5 % known"
expect 1 talus-trn plane.ply -o off.tif --window 600000,5199900,600300,5200300
says "the grid asked for lies outside of the data"
nothing_left off.tif

# without a cell size: near the distance of the points, and where another raster has its nodes
expect 0 talus-trn plane.ply -o natural.tif
prints "nodes, 20 m apart"
expect 0 talus-trn plane.ply -o like.tif --like wide.tif --reference plane.tif
prints "101 x 101 nodes"
prints "RMSE 0 m"
expect 1 talus-trn plane.ply -o off.tif --like wide.tif --cell-size-m 5
says "give one of --like and --cell-size-m"

# points with heights, in another CRS: reprojected with a note, 3 m too low and one outside
awk 'BEGIN {
  print "{\"type\": \"FeatureCollection\", \"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"urn:ogc:def:crs:EPSG::32632\"}}, \"features\": ["
  for (i = 0; i < 10; ++i)
    printf "%s{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {\"type\": \"Point\", \"coordinates\": [%d, 5200090, %d]}}", (i ? "," : ""), 500007 + 25 * i, 500 + (7 + 25 * i) / 2 - 3
  print "]}" }' >points.json
expect 0 ogr2ogr -t_srs EPSG:4326 -lco RFC7946=NO degrees.geojson points.json
expect 0 talus-trn plane.ply -o points.tif --cell-size-m 4 --reference-points degrees.geojson --report points.report.json
says "reprojected from EPSG:4326"
prints "covers 80 %"
awk -F: '/"mae_m"/ { exit !($2 + 0 > 2.9 && $2 + 0 < 3.6) }' points.report.json || fail "$(grep mae_m points.report.json)"
bad_points() { # bad_points GEOMETRY WORDS
  printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":%s}]}' "$1" >bad.geojson
  expect 1 talus-trn plane.ply -o off.tif --reference-points bad.geojson
  says "$2"
  nothing_left off.tif
}
bad_points '{"type":"Point","coordinates":[500010,5200010]}' "the points have no elevation: they are 2-D"
bad_points '{"type":"LineString","coordinates":[[500010,5200010,1],[500020,5200010,1]]}' "layer bad: holds no points, but 1 line; expected points"
bad_points null "1 of 1 features have no geometry"

# options that do not fit are refused
expect 1 talus-trn plane.ply -o off.tif --t-srs EPSG:31287
says "a TIN is not reprojected"
expect 1 talus-trn plane.ply -o off.tif --crs EPSG:31287
says "the CRS is EPSG:32632"

# coordinates that are not metres, by the TIN's header or by --crs; a header may hold the code alone
LC_ALL=C sed '/^comment crs/d' plane.ply >local.ply
header() { # header FILE COMMENT: the TIN without CRS with one comment more
  LC_ALL=C sed "s/^format binary_little_endian 1.0$/&\\ncomment $2/" local.ply >"$1"
}
for epsg in 4326 2263 3857; do
  header "$epsg.ply" "crs EPSG:$epsg"
  for source in "$epsg.ply" "local.ply --crs EPSG:$epsg"; do
    expect 1 talus-trn $source -o off.tif
    says "the CRS is EPSG:$epsg"
    says "hint: a TIN is not reprojected: make it from the contours with talus-tin --t-srs EPSG:"
    nothing_left off.tif
  done
done
header code.ply "crs EPSG:32632"
expect 0 talus-trn code.ply -o code.tif --cell-size-m 4
gdalinfo code.tif | grep -qF 'ID["EPSG",32632]' || fail "the CRS named by its code was lost"
header nonsense.ply "crs EPSG:nonsense"
expect 1 talus-trn nonsense.ply -o off.tif
says "nonsense.ply: its CRS: \"EPSG:nonsense\" is not a CRS"

# a TIN that is not a ground: no area in plan, higher than the Earth
triangle() { # triangle BYTES: bytes x, y and two of z for each of the three corners
  printf 'ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty ushort z\n'
  printf 'element face 1\nproperty list uchar uchar vertex_indices\nend_header\n'
  printf "$1\003\000\001\002"
}
triangle '\000\000\000\000\012\000\000\000\024\000\000\000' >line.ply
expect 1 talus-trn line.ply -o off.tif
says "no triangle has an area in plan"
triangle '\000\000\377\177\012\000\377\177\000\012\377\177' >high.ply
expect 1 talus-trn high.ply -o off.tif
says "is 32767 m, expected at most 9000 m either way"
nothing_left off.tif
head -c 500 plane.ply >cut.ply
expect 1 talus-trn cut.ply -o off.tif
says "cut.ply"
echo "no TIN" >words.ply
expect 1 talus-trn words.ply -o off.tif
says "words.ply"
nothing_left off.tif
