# The traps of the real elevation models: Int16 with its own nodata, cells of 4.99768 m, footprints
# with up to 41 % nodata, surfaces without a CRS. Values come through bit for bit.
[ -d "$shared_data/dem" ] || skip "there is no ../shared/data beside the checkout"
dem=$shared_data/dem

same_values() { # same_values DEM TRN [NODATA of the DEM]
  gdalwarp -q -overwrite -of ENVI -ot Float64 -srcnodata "${3:--9999}" -dstnodata -9999 -r near "$1" dem.bin
  gdal_translate -q -of ENVI -ot Float64 "$2" trn.bin
  cmp dem.bin trn.bin || fail "$1: values differ"
}
for name in gschnitz_gar_5m gschnitz_gar_full_5m lechtal_kot_full_5m arlberg_wog_full_5m serles_10m; do
  expect 0 talus-trn "$dem/$name.tif" -o $name.tif --report $name.json --no-db
  same_values "$dem/$name.tif" $name.tif
done
grep -q '"covered_share": 0.58' gschnitz_gar_full_5m.json || fail "41 % of gschnitz_gar_full are unknown"
expect 0 talus-trn "$dem/SainteHelens.dem" -o helens.tif --no-db
prints "327 x 468 nodes, 30 m apart, 97.3 % known, 682 to 2543 m"
same_values "$dem/SainteHelens.dem" helens.tif -32767

# 4.99768 means the DEM's own cell of 4.997678230579; 5 does not
expect 0 talus-trn "$dem/gschnitz_gar_5m.tif" -o own.tif --cell-size-m 4.99768 --no-db
says "the nodes are the DEM's own, 4.99767823058 m apart"
gdal_translate -q -of ENVI own.tif own.bin
gdal_translate -q -of ENVI gschnitz_gar_5m.tif gschnitz.bin
cmp own.bin gschnitz.bin || fail "4.99768 was not the DEM's own"
expect 0 talus-trn "$dem/gschnitz_gar_5m.tif" -o five.tif --cell-size-m 5 --reference "$dem/gschnitz_gar_5m.tif" --report five.json --no-db
gdalinfo five.tif | grep -q "Pixel Size = (5.0" || fail "5 m became something else"
grep -q '"n": ' five.json || fail "nothing compared"

# --like: nodes that coincide with another raster's
expect 0 talus-trn "$dem/gschnitz_gar_full_5m.tif" -o like.tif --like "$dem/gschnitz_gar_5m.tif" --no-db \
  --reference "$dem/gschnitz_gar_5m.tif"
prints "172 x 146 nodes"
prints "RMSE 0 m"

# no CRS
expect 1 talus-trn "$dem/maungawhau_volcano_r_10m.asc" -o volcano.tif --no-db
says "there is no CRS"
expect 0 talus-trn "$dem/maungawhau_volcano_r_10m.asc" -o volcano.tif --crs none --no-db
prints "87 x 61 nodes, 10 m apart, 100 % known"
expect 0 talus-trn "$shared_data/experiments/tschamut2014/terrain.asc" -o tschamut.tif --crs none --no-db

# degrees: refused, and the command that the hint gives works
gdalwarp -q -t_srs EPSG:4326 -r bilinear "$dem/serles_10m.tif" degrees.tif
expect 1 talus-trn degrees.tif -o metres.tif --no-db
srs=$(sed -n 's/.*hint: --t-srs \(EPSG:[0-9]*\) .*/\1/p' err)
[ "$srs" = EPSG:32632 ] || fail "the hint names $srs"
expect 0 talus-trn degrees.tif -o metres.tif --t-srs "$srs" --cell-size-m 10 --no-db
gdalinfo metres.tif | grep -qF 'ID["EPSG",32632]' || fail "not in UTM"
expect 0 talus-trn "$dem/serles_10m.tif" -o utm.tif --t-srs EPSG:32632 --cell-size-m 10 --no-db
expect 0 talus-trn metres.tif -o check.tif --reference utm.tif --report check.json --no-db
awk -F: '/"rmse_m"/ { exit !($2 + 0 < 3) }' check.json || fail "twice and once reprojected differ by $(grep rmse_m check.json)"
