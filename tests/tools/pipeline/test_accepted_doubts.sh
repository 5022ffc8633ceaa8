# A height of a contour map that cannot be, and that the user accepts: make continues from the
# contours to the maps, and every file names the accepted doubt.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v ogrinfo >/dev/null || skip "needs gdal-bin"
site doubt
layer=$(ogrinfo -q doubt/contours.gpkg | sed -n '1s/^1: \([^ ]*\).*/\1/p')
ogrinfo -q doubt/contours.gpkg -sql "UPDATE $layer SET elevation_m = elevation_m - 900 WHERE elevation_m = (SELECT MAX(elevation_m) FROM $layer)" >/dev/null
expect 2 make -C doubt BIN= terrain
says "make TIN_FLAGS=--accept-doubts"
made doubt maps TIN_FLAGS=--accept-doubts CHECK_FLAGS='--accept-doubts --probe-s 0'
[ -s doubt/out/maps/reach.tif ] || fail "no map"
for file in trn bed; do
  gdalinfo doubt/out/$file.tif | grep -q 'DOUBTS_ACCEPTED=contour at' || fail "$file.tif does not say what was accepted"
done
grep -q '"accepted_places": "contour at' doubt/out/blocks.json || fail "blocks.json does not say it"

# the same of an elevation model with a tower
site dem
sed -i 's/^contours = .*/dem = "dem.tif"/' dem/site.toml
gdal_translate -q -of AAIGrid -ot Float32 doubt/out/trn.tif whole.asc
awk 'NR == 10 { $5 += 1000 } 1' whole.asc >tower.asc
gdal_translate -q -a_srs EPSG:32633 tower.asc dem/dem.tif
expect 2 make -C dem BIN= terrain
flags=$(grep -o 'TRN_FLAGS=--accept-doubts' err | head -n 1)
made dem maps "$flags" CHECK_FLAGS='--accept-doubts --probe-s 0'
