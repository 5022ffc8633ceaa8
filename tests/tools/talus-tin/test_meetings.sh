# Contours that meet because the map is generalised are moved apart within its accuracy, and said.
. "$source_dir/tests/tools/talus-tin/map.sh"
command -v gdal_contour >/dev/null || skip "needs gdal-bin"
# a wall of 50 m along a winding edge on a slope, contours every 5 m
awk 'BEGIN {
  print "ncols 180\nnrows 150\nxllcorner 400000\nyllcorner 5100000\ncellsize 2"
  for (r = 0; r < 150; r++) {
    line = ""
    for (c = 0; c < 180; c++) {
      x = 2 * c; y = 2 * (149 - r)
      d = y - 140 - 15 * sin(x / 31) - 4 * sin(x / 6.1)
      line = line sprintf(" %.3f", 700 + 0.5 * y + 50 / (1 + exp(-d / 1.6)) + sin(x / 9) + sin(y / 8 + x / 15))
    }
    print line
  }
}' >wall.asc
gdal_translate -q -a_srs EPSG:25833 wall.asc wall.tif
gdal_contour -q -i 5 -a ELEV wall.tif whole.gpkg
ogr2ogr -q -simplify 1.5 general.geojson whole.gpkg -lco COORDINATE_PRECISION=3
places() { ogr2ogr -q -f CSV /vsistdout/ "$1" -lco GEOMETRY=AS_XY -sql "SELECT geom, what, value FROM doubts WHERE state = '$2'"; }
n_places() { places "$1" "$2" | sed 1d | wc -l; }

expect 0 talus-tin whole.gpkg -o whole.ply --report whole.json
! grep -q meetings whole.json || fail "sound contours were mended"
expect 1 talus-tin general.geojson -o bad.ply --tolerance-m 0 --doubts refused.gpkg
says "expected lines of different height to stay apart"
says "all places are in refused.gpkg"
nothing_left bad.ply
n=$(n_places refused.gpkg refused)
[ "$n" -ge 5 ] || fail "$n places of meetings"
expect 0 talus-tin general.geojson -o mended.ply --report mended.json --doubts mended.gpkg
says "warning: general.geojson: $n meeting contours, the first at"
[ "$(value mended.json n_mended)" = "$n" ] || fail "$(grep n_mended mended.json)"
[ "$(value mended.json tolerance_from)" = "bends of the contours" ] || fail "whose tolerance?"
awk -v t="$(value mended.json tolerance_m)" -v m="$(value mended.json largest_move_m)" \
  'BEGIN { exit !(t > 1 && t < 3 && m > 0 && m <= t) }' || fail "tolerance, move: $(grep _m mended.json)"
places mended.gpkg mended | awk -F, -v t="$(value mended.json tolerance_m)" \
  '/moved/ { ++n; if ($4 + 0 > t + 0 || $4 + 0 <= 0) exit 1 } END { exit n == 0 }' || fail "places of moved points"

# the mended map is as good as the generalised one can be
for map in whole mended; do talus-trn $map.ply -o $map.tif --cell-size-m 2 --reference wall.tif --report $map.trn.json --no-db -q; done
awk -v a="$(value whole.trn.json rmse_m)" -v b="$(value mended.trn.json rmse_m)" 'BEGIN { exit !(b < a + 1.5) }' ||
  fail "RMSE $(value whole.trn.json rmse_m) and $(value mended.trn.json rmse_m) m"
expect 0 talus-tin general.geojson -o again.ply --doubts again.gpkg
cmp mended.ply again.ply || fail "not the same bytes"

# contours drawn as one line along a cliff: the hint's option parts them in their order
lines "100:500000,5200000;500040,5200000;500060,5200040;500100,5200040;500120,5200000;500160,5200000" \
  "110:500000,5200020;500040,5200020;500060,5200040;500100,5200040;500120,5200020;500160,5200020" \
  "120:500000,5200040;500160,5200040" "130:500000,5200060;500160,5200060" >one.geojson
expect 1 talus-tin one.geojson -o bad.ply --doubts one.gpkg
says "--tolerance-m"
[ "$(n_places one.gpkg refused)" = 6 ] || fail "$(places one.gpkg refused)"
expect 0 talus-tin one.geojson -o one.ply --tolerance-m 0.5
talus-trn one.ply -o one.tif --cell-size-m 1 --no-db -q
for place in "500080 5200038 100" "500080 5200042 121"; do
  set -- $place
  gdallocationinfo -geoloc -valonly one.tif "$1" "$2" | awk -v z="$3" '{ exit !(($1 - z) ^ 2 < 1) }' || fail "$place"
done
# lines that truly cross are not mended, with any option
lines "100:500000,5200000;500100,5200100" "110:500000,5200100;500100,5200000" >crossing.geojson
expect 1 talus-tin crossing.geojson -o bad.ply --tolerance-m 10
says "moving points by 10 m does not bring them apart"
expect 2 talus-tin crossing.geojson -o bad.ply --tolerance-m -1
nothing_left bad.ply
