# The genuine map: a third of its area is flat triangles, elevation in a field of its own name, spot
# heights in a second layer; and the derived maps reach the accuracy asked for.
. "$source_dir/tests/tools/talus-tin/map.sh"
[ -d "$shared_data/contours" ] || skip "no shared data beside the checkout"
expect 0 talus-tin "$shared_data/contours/su42_os_terrain50_contours.gpkg" -o su42.ply --report su42.json
says "elevation from field PROP_VALUE of layer contours"
awk -v a="$(value su42.json share_before)" -v b="$(value su42.json share_after)" 'BEGIN { exit !(a > 0.35 && a < 0.36 && b < 0.01) }' ||
  fail "flat share $(value su42.json share_before) before, $(value su42.json share_after) after"
expect 0 talus-tin "$shared_data/contours/su42_os_terrain50_contours.gpkg" -o spots.ply \
  --spots "$shared_data/contours/su42_os_terrain50_contours.gpkg" --report spots.json
[ "$(value spots.json n_spots)" -gt 50 ] || fail "$(value spots.json n_spots) spot heights read"

# rmse MAP DEM MODE
rmse() {
  expect 0 talus-tin "$shared_data/contours/$1.gpkg" -o "$1.ply" --flat "$3" --overwrite
  expect 0 talus-trn "$1.ply" -o "$1.tif" --like "$shared_data/dem/$2.tif" \
    --reference "$shared_data/dem/$2.tif" --report "$1.json" --overwrite
  value "$1.json" rmse_m
}
# site MAP DEM GAIN: the error falls by the share asked for against the plain triangles
site() {
  plain=$(rmse "$1" "$2" keep)
  mended=$(rmse "$1" "$2" fill)
  awk -v a="$plain" -v b="$mended" -v gain="$3" 'BEGIN { exit !(b <= a * (1 - gain)) }' ||
    fail "$1: RMSE $mended m mended, $plain m plain, expected at least $3 lower"
}
site gschnitz_gar_10m gschnitz_gar_5m 0.12
site gschnitz_gar_20m gschnitz_gar_5m 0.22
site salisbury_crags_5m salisbury_crags_dsm_2m5 0.10
site lechtal_kotcliff_5m lechtal_kotcliff_5m 0
site lechtal_kotdam_10m lechtal_kotdam_5m 0
