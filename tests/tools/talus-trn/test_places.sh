# A raster whose coordinates contradict its CRS is refused with the likely system; the
# commands of the hints give the right ground.
. "$source_dir/tests/tools/talus-trn/plane.sh"
plane plane.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 plane.asc utm.tif
expect 0 talus-trn utm.tif -o right.tif --no-db
is_plane right.tif 1e-6 1681
[ ! -s err ] || fail "a map in its place is spoken of: $(cat err)"

# refused FILE FINDING: and nothing is left
refused() {
  expect 1 talus-trn "$1" -o bad.tif --no-db
  says "$2"
  nothing_left bad.tif
}

# eastings with the number of the zone, under the CRS without it: both hints
plane prefix.asc 32650000
gdal_translate -q -ot Float64 -a_srs EPSG:25832 prefix.asc prefix.tif
refused prefix.tif "the eastings begin with the zone number 32, which this CRS leaves out"
says "hint: --crs EPSG:4647 --t-srs EPSG:25832"
expect 0 talus-trn prefix.tif -o mended_trn.tif --crs EPSG:4647 --t-srs EPSG:25832 --no-db
says "where its coordinates cannot be; taken as EPSG:4647"
is_plane mended_trn.tif 1e-6
gdal_translate -q -ot Float64 -a_srs EPSG:32632 prefix.asc wgs.tif
refused wgs.tif "the eastings begin with the zone number 32"
run_hint
expect 0 talus-trn mended.tif -o mended_trn.tif --overwrite --no-db
is_plane mended_trn.tif 1e-6
rm mended.tif

# the number of another zone: nothing is shifted, the hint asks for the CRS
plane gauss.asc 3550000
gdal_translate -q -ot Float64 -a_srs EPSG:25832 gauss.asc gauss.tif
refused gauss.tif "as eastings of zone 3 of Gauss and Krueger (meridian 9 E) they would lie in it"
says "hint: is it the CRS of these coordinates? name the right one with --crs EPSG:code"
expect 0 talus-trn gauss.tif -o mended_trn.tif --crs EPSG:31467 --overwrite --no-db
is_plane mended_trn.tif 1e-6

# a country in one zone: its far side is warned of; of a whole continent the window alone is judged
gdal_translate -q -ot Float64 -a_srs EPSG:25833 -a_ullr -31540 6735305 -31335 6735100 plane.asc wide.tif
expect 0 talus-trn wide.tif -o wide_trn.tif --no-db
says "warning: wide.tif: its coordinates"
prints "100 % known, 1001.25 to 1101.25 m"
gdal_translate -q -ot Float64 -a_srs EPSG:25833 -a_ullr -2000000 6000000 2000000 2000000 plane.asc continent.tif
refused continent.tif "lie outside the area that EPSG:25833"
expect 0 talus-trn continent.tif -o window_trn.tif --window 300000,5200000,700000,5600000 --no-db
if grep -q warning: err && ! grep -q "steeper than 70" err; then fail "the window lies in the zone: $(cat err)"; fi

# northings of a zone beyond the equator, as satellite images have them: the command of the hint
gdal_translate -q -ot Float64 -a_srs EPSG:32619 -a_ullr 350000 -1650000 350205 -1650205 plane.asc landsat.tif
refused landsat.tif "they lie in its zone on the other side of the equator"
says "hint: --t-srs EPSG:32719 reprojects"
expect 0 talus-trn landsat.tif -o south.tif --t-srs EPSG:32719 --no-db
gdalinfo south.tif | grep -q "^Upper Left *( *350000.000, *8350000.000)" || fail "not 10,000 km to the north: $(gdalinfo south.tif | grep Upper)"
gdal_translate -q -a_srs EPSG:32719 -a_ullr 350000 8350000 350205 8349795 landsat.tif moved.tif
expect 0 talus-trn south.tif -o compared.tif --reference moved.tif --no-db
prints "largest 0 m"

# feet in plan
plane feet.asc 2132545.931758530 17060367.454068240 16.40419947506562 1
gdal_translate -q -ot Float64 -a_srs EPSG:25832 feet.asc feet.tif
refused feet.tif "as feet they would lie in it"
run_hint
expect 0 talus-trn mended.tif -o mended_trn.tif --overwrite --no-db
is_plane mended_trn.tif 1e-3
rm mended.tif

# x and y exchanged
gdal_translate -q -a_ullr 5200000 650205 5200205 650000 -a_srs EPSG:25832 plane.asc exchanged.tif
refused exchanged.tif "with x and y exchanged they would lie in it"

# degrees under a CRS in metres: the hint gives the ground
gdalwarp -q -t_srs EPSG:4326 -r bilinear -dstnodata -9999 utm.tif degrees.tif
gdal_translate -q -a_srs EPSG:25832 degrees.tif lying.tif
refused lying.tif "they look like degrees"
says "hint: --crs EPSG:4326 --t-srs EPSG:25832"
expect 0 talus-trn lying.tif -o mended_trn.tif --crs EPSG:4326 --t-srs EPSG:25832 --overwrite --no-db
is_plane mended_trn.tif 0.5

# metres stretched, under any name of the projection
for code in EPSG:32662 EPSG:6933 EPSG:3857 "+proj=eqc +lat_ts=20 +ellps=GRS80 +towgs84=0,0,0"; do
  gdalwarp -q -overwrite -t_srs "$code" -tr 5 5 -r bilinear -dstnodata -9999 utm.tif rimmed.tif
  # without its rim, where gdalwarp repeats values by half a cell
  set -- $(gdalinfo rimmed.tif | sed -n 's/^Size is \([0-9]*\), \([0-9]*\)$/\1 \2/p')
  gdal_translate -q -srcwin 6 6 $(($1 - 12)) $(($2 - 12)) rimmed.tif stretched.tif
  refused stretched.tif "whose metres are stretched here"
  says "hint: --t-srs EPSG:32632 reprojects"
  expect 0 talus-trn stretched.tif -o mended_trn.tif --t-srs EPSG:32632 --overwrite --no-db
  is_plane mended_trn.tif 0.5 500
done

# axes to the west and south
gdal_translate -q -a_srs "+proj=tmerc +lat_0=0 +lon_0=11 +axis=wsu +ellps=GRS80 +towgs84=0,0,0" -a_ullr 20000 -5200000 20205 -5200205 plane.asc south.tif
refused south.tif "expected x to the east and y to the north"

# a sheet of the neighbours' zone is warned of; Austria is not in New Zealand
gdal_translate -q -ot Float64 -a_srs EPSG:25832 -a_ullr 820000 5200205 820205 5200000 plane.asc beside.tif
expect 0 talus-trn beside.tif -o beside_trn.tif --no-db
says "warning: beside.tif: its coordinates"
gdal_translate -q -ot Float64 -a_srs EPSG:2193 plane.asc far.tif
refused far.tif "lie outside the area that EPSG:2193"
refused_reference() { expect 1 talus-trn utm.tif -o bad.tif --reference "$1" --no-db; says "$2"; nothing_left bad.tif; }
refused_reference far.tif "lie outside the area that EPSG:2193"

# a datum that is not known
gdal_translate -q -ot Float64 -a_srs "+proj=tmerc +lat_0=0 +lon_0=10.3333333333333 +k=1 +x_0=0 +y_0=-5000000 +ellps=bessel +units=m" -a_ullr 80000 236205 80205 236000 plane.asc bessel.tif
expect 1 talus-trn bessel.tif -o bad.tif --t-srs EPSG:25832 --no-db
says "PROJ knows no shift of the datum"
nothing_left bad.tif
expect 0 talus-trn bessel.tif -o named.tif --crs EPSG:31254 --t-srs EPSG:25832 --report named.json --no-db
says "whose datum is not known; taken as EPSG:31254"
grep -q '"operations"' named.json || fail "the operation does not stand in the report"
set -- $(echo "80100 236100" | gdaltransform -s_srs EPSG:31254 -t_srs EPSG:25832 -output_xy)
value() { gdallocationinfo -valonly -geoloc "$1" "$2" "$3"; }
awk -v z="$(value named.tif "$1" "$2")" 'BEGIN { exit !((z - 1050) ^ 2 < 4) }' ||
  fail "the plane is $(value named.tif "$1" "$2") m at its middle, expected 1050"
expect 0 talus-trn bessel.tif -o guessed.tif --t-srs EPSG:25832 --accept-ballpark --no-db
says "the place may be off by a hundred metres"
# the changes are recorded
expect 0 talus-trn bessel.tif -o kept.tif --crs EPSG:31254 --t-srs EPSG:25832
talus-runs show 1 >show 2>&1 || true
grep -q "reprojected from" show || fail "the registry does not hold the operation"
