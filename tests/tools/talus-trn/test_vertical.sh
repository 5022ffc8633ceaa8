# Heights change only when asked for, by the one model that applies; a missing model is refused.
. "$source_dir/tests/tools/talus-trn/plane.sh"
plane plane.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 plane.asc utm.tif
gdal_translate -q -ot Float64 -a_srs EPSG:25832+5773 plane.asc egm96.tif
height() { gdallocationinfo -valonly "$1" 20 20; }
is_near() { awk -v a="$1" -v b="$2" -v d="$3" 'BEGIN { exit !((a - b) ^ 2 < d ^ 2) }' || fail "$1, expected $2 within $3"; }

# heights above the ellipsoid to heights above the geoid: as the grid of PROJ says, read by GDAL
expect 0 talus-trn utm.tif -o geoid.tif --vertical-crs ellipsoidal --t-vertical EPSG:5773 --report geoid.json --no-db
says "heights taken from heights above the ellipsoid to EPSG:5773 (EGM96 height) by"
grep -q "EGM96" geoid.json || fail "the report does not say how"
gdalinfo geoid.tif >info
grep -q "EGM96 height" info || fail "the terrain does not say what its heights are in"
grid=$(find /usr/share/proj /usr/local/share/proj -name egm96_15.gtx -o -name us_nga_egm96_15.tif 2>/dev/null | head -n 1)
set -- $(echo "650102.5 5200102.5" | gdaltransform -s_srs EPSG:25832 -t_srs EPSG:4326 -output_xy)
[ -z "$grid" ] || {
  gdal_translate -q -of VRT "$grid" grid.vrt
  gdalwarp -q -r bilinear -t_srs EPSG:25832 -te 650000 5200000 650205 5200205 -tr 5 5 grid.vrt undulation.tif
  is_near "$(height geoid.tif)" "$(awk -v z="$(height utm.tif)" -v n="$(gdallocationinfo -valonly undulation.tif 20 20)" 'BEGIN { printf "%.6f", z - n }')" 0.02
}
is_near "$(height geoid.tif)" "$(awk -v z="$(height utm.tif)" 'BEGIN { print z - 49.69 }')" 0.03
# the same file and command give the same bytes
expect 0 talus-trn utm.tif -o again.tif --vertical-crs ellipsoidal --t-vertical EPSG:5773 --no-db
gdal_translate -q -of ENVI geoid.tif a.bin && gdal_translate -q -of ENVI again.tif b.bin
cmp a.bin b.bin || fail "heights differ on repeat"
# with the plan reprojected, and of a file of three axes
expect 0 talus-trn utm.tif -o both.tif --vertical-crs ellipsoidal --t-vertical EPSG:5773 --t-srs EPSG:25833 --no-db
mean() { gdalinfo -stats "$1" | sed -n 's/.*STATISTICS_MEAN=//p' | head -n 1; }
is_near "$(mean both.tif)" "$(mean geoid.tif)" 5

# where they are already
expect 0 talus-trn egm96.tif -o same.tif --t-vertical EPSG:5773 --no-db
is_near "$(height same.tif)" "$(height egm96.tif)" 1e-9
# named, not changed
expect 0 talus-trn utm.tif -o said.tif --vertical-crs EPSG:5773 --no-db
is_near "$(height said.tif)" "$(height utm.tif)" 1e-9
gdalinfo said.tif >info
grep -q "EGM96 height" info || fail "the heights that the user names are not written"

# refused: heights in nothing that is said, in something else, to a model that is not here or not for here
refused() { finding=$1; shift; expect 1 talus-trn "$@" -o bad.tif --no-db; says "$finding"; nothing_left bad.tif; }
refused "does not say what system its heights are in" utm.tif --t-vertical EPSG:5773
says "--vertical-crs ellipsoidal"
refused "its heights are in EPSG:5773 (EGM96 height), not in EPSG:7837" egm96.tif --vertical-crs EPSG:7837
refused "PROJ knows no operation for that here" egm96.tif --t-vertical EPSG:5703
for words in EPSG:25832 EPSG:6360 none nonsense; do
  expect 2 talus-trn utm.tif -o bad.tif --vertical-crs $words --no-db
done
expect 2 talus-trn utm.tif -o bad.tif --vertical-crs EPSG:5773 --t-vertical ellipsoidal --no-db
missing=$(find /usr/share/proj /usr/local/share/proj -name '*egm08*' 2>/dev/null | head -n 1)
[ -n "$missing" ] || {
  refused "needs the grid" egm96.tif --t-vertical EPSG:3855
  says "projsync --file"
  says "heights are the same on every machine"
}
nothing_left bad.tif
