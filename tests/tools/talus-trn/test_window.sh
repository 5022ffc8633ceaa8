# A window that reaches beyond the data: the part that is missing is said, of any source.
. "$source_dir/tests/tools/talus-trn/plane.sh"
plane dem.asc
gdal_translate -q -a_srs EPSG:25832 dem.asc dem.tif
awk 'BEGIN { for (y = 0; y <= 200; y += 20) for (x = 0; x <= 200; x += 20) print 650000 + x "," 5200000 + y "," 1000 + y / 2 }' |
  sed '1i x,y,z' >points.csv
expect 0 talus-tin points.csv --points --crs EPSG:25832 -o tin.ply

for source in dem.tif tin.ply; do
  expect 0 talus-trn $source -o trn.tif --overwrite --cell-size-m 5 --window 650105,5200105,650305,5200205
  says "warning: $source: --window 650105,5200105,650305,5200205 reaches beyond what is there, 650000,5200000 to 6502"
  grep -qE ': 5[0-9.]* % of it is missing' err || fail "$(cat err)"
  is_plane trn.tif 1e-9 400
  # what ends within half a cell of the data does not reach beyond them
  expect 0 talus-trn $source -o trn.tif --overwrite --cell-size-m 5 --window 649998,5200000,650200,5200202
  ! grep -q 'reaches beyond' err || fail "$(cat err)"
  expect 0 talus-trn $source -o trn.tif --overwrite --cell-size-m 20 --window 650000,5200000,650200,5200200
  ! grep -q 'reaches beyond' err || fail "$(cat err)"
  expect 1 talus-trn $source -o off.tif --window 650305,5200105,650405,5200205
  says "the grid asked for lies outside of the data"
  nothing_left off.tif
done

# the raster of --like ends before the data do
expect 0 talus-trn dem.tif -o like.tif --window 650000,5200000,650100,5200205
expect 0 talus-trn dem.tif -o trn.tif --overwrite --like like.tif --window 650000,5200000,650200,5200205
says "5200000 to 650105,5200205: 47.5 % of it is missing"

# a site's window goes the same way
printf '[site]\nname = "t"\ncrs = "EPSG:25832"\n[terrain]\ndem = "dem.tif"\nwindow_m = [650105, 5200105, 650305, 5200205]\n' >site.toml
expect 0 talus-site site.toml -o stages
expect 0 talus-trn dem.tif -o trn.tif --overwrite $(sed -n 's/^SITE_TRN_FLAGS := //p' stages/site.mk)
says "reaches beyond what is there"
