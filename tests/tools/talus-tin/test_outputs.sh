# Outputs: the same bytes every time, nothing over an existing file, mended flats reported.
. "$source_dir/tests/tools/talus-tin/map.sh"
cone >map.geojson
expect 0 talus-tin map.geojson -o one.ply --report one.json
expect 0 talus-tin map.geojson -o two.ply
cmp -s one.ply two.ply || fail "two runs wrote different bytes"
expect 1 talus-tin map.geojson -o one.ply
says "--overwrite"
expect 0 talus-tin map.geojson -o one.ply --overwrite
expect 1 talus-tin map.geojson -o missing_folder/one.ply

# fill raises the summit, keep leaves it
expect 0 talus-tin map.geojson -o keep.ply --flat keep --report keep.json
awk -v a="$(value keep.json share_after)" -v b="$(value one.json share_after)" 'BEGIN { exit !(a > 0.1 && b < 0.1 * a) }' ||
  fail "flat share $(value keep.json share_after) kept, $(value one.json share_after) mended"
expect 0 talus-tin map.geojson -o fine.ply --fill-spacing-m 5 --report fine.json
[ "$(value fine.json n_points_added)" -gt "$(value one.json n_points_added)" ] || fail "a finer spacing adds no points"
expect 2 talus-tin map.geojson -o bad.ply --flat perhaps
expect 2 talus-tin map.geojson -o bad.ply --fill-spacing-m -1
expect 2 talus-tin map.geojson

# held back: every second height, as points that talus-trn compares with
expect 0 talus-tin map.geojson -o held.ply --hold-out-every 2 --hold-out points.gpkg --report held.json
ogrinfo -al -so points.gpkg | grep -q "Feature Count: 25" || fail "expected the 25 points of the ring at 110 m"
expect 0 talus-trn held.ply -o held.tif --cell-size-m 2 --reference-points points.gpkg
prints "RMSE"
expect 2 talus-tin map.geojson -o bad.ply --hold-out-every 1 --hold-out p.gpkg
expect 2 talus-tin map.geojson -o bad.ply --hold-out-every 2
says "go together"
expect 1 talus-tin map.geojson -o bad.ply --hold-out-every 2 --hold-out nowhere/p.gpkg

# equal-height touches and repeated points are cleaned and counted
lines "100:500000,5200000;500100,5200000;500100,5200000" "100:500050,5200000;500050,5199950" \
  "110:500000,5200050;500100,5200050" >touch.geojson
expect 0 talus-tin touch.geojson -o touch.ply --report touch.json
[ "$(value touch.json duplicate_points)" = 1 ] || fail "repeated point not counted"
[ "$(value touch.json touches_at_one_height)" = 1 ] || fail "touch not counted"
expect 0 talus-tin touch.geojson -o json.ply --json
prints '"touches_at_one_height": 1'
nothing_left bad.ply p.gpkg

# a disk that is full
if mkdir full && mount -t tmpfs -o size=4k tmpfs full 2>/dev/null; then
  code=0
  talus-tin map.geojson -o full/tin.ply --no-db >out 2>err || code=$?
  left=$(ls -A full)
  umount full
  [ "$code" -eq 1 ] || fail "exit code $code on a full disk, expected 1"
  says "cannot be written"
  [ -z "$left" ] || fail "left on the full disk: $left"
fi
