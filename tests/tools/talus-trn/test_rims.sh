# Unknown cells stay unknown: around a raster that is reprojected, below an alpha band or a mask.
. "$source_dir/tests/tools/talus-trn/plane.sh"

# a plane in degrees, a third of a second wide, with a hole: the truth at its centres by gdaltransform
corner=$(echo "650000 5200000" | gdaltransform -s_srs EPSG:25832 -t_srs EPSG:4326 -output_xy)
lon=${corner% *} lat=${corner#* }
awk -v lon="$lon" -v lat="$lat" 'BEGIN {
  for (r = 0; r < 60; r++) for (c = 0; c < 60; c++) printf "%.12f %.12f\n", lon + (c + 0.5) / 10800, lat + (59.5 - r) / 10800
}' | gdaltransform -s_srs EPSG:4326 -t_srs EPSG:25832 -output_xy |
  awk -v lon="$lon" -v lat="$lat" 'BEGIN {
    printf "ncols 60\nnrows 60\nxllcorner %.12f\nyllcorner %.12f\ncellsize %.17g\nNODATA_value -32768\n", lon, lat, 1 / 10800
  } { r = int((NR - 1) / 60); c = (NR - 1) % 60
      printf "%s%s", (r >= 20 && r < 24 && c >= 20 && c < 24) ? "-32768" : sprintf("%.6f", 1000 + 0.5 * ($2 - 5200000)), c == 59 ? "\n" : " " }' >degrees.asc
gdal_translate -q -ot Float64 -a_srs EPSG:4326 degrees.asc degrees.tif
expect 0 talus-trn degrees.tif -o utm.tif --t-srs EPSG:25832 --no-db
says "by \"Inverse of"
is_plane utm.tif 0.02 2000  # 2.5 m where the rim is invented
n_hole=$(off utm.tif | cut -d' ' -f2)
expect 0 talus-trn degrees.tif -o other.tif --t-srs EPSG:25833 --no-db
# again by a mask beside the raster instead of a value, and by an alpha band
gdalwarp -q -r near -dstalpha degrees.tif alpha.tif
expect 0 talus-trn alpha.tif -o alpha_utm.tif --t-srs EPSG:25832 --no-db
is_plane alpha_utm.tif 0.02 2000
[ "$(off alpha_utm.tif | cut -d' ' -f2)" = "$n_hole" ] || fail "other nodes are known below an alpha band"
gdal_translate -q -b 1 -mask 2 alpha.tif masked.tif
expect 0 talus-trn masked.tif -o masked_utm.tif --t-srs EPSG:25832 --no-db
[ "$(off masked_utm.tif | cut -d' ' -f2)" = "$n_hole" ] || fail "other nodes are known below a mask"

# a plane whose second band is alpha, and whose unknown cells are 0
plane plane.asc
sed '7,12s/ [0-9.]*/ -9999/g' plane.asc >gap.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 gap.asc gap.tif
gdalwarp -q -r near -dstalpha gap.tif alpha2.tif
gdal_translate -q -a_nodata none alpha2.tif alpha3.tif
expect 0 talus-trn alpha3.tif -o alpha_trn.tif --no-db
is_plane alpha_trn.tif 1e-6 1435
[ "$(off alpha_trn.tif | cut -d' ' -f2)" = 1435 ] || fail "35 rows of 41 nodes are known, not $(off alpha_trn.tif)"

# two bands without a statement of their roles: the hint that keeps the mask
gdal_translate -q -colorinterp gray,undefined alpha3.tif two.tif
expect 1 talus-trn two.tif -o bad.tif --no-db
says "the raster has 2 bands, expected one"
sed -n 's/^ *hint: .*where band 2 says which cells are known: //p' err >hint.sh
sh -e hint.sh >/dev/null
expect 0 talus-trn one_band.tif -o one_trn.tif --no-db
[ "$(off one_trn.tif | cut -d' ' -f2)" = 1435 ] || fail "the mask was lost on the way that the hint says"
nothing_left bad.tif

# several rasters in one file, with the names that choose: of a GeoPackage, of a TIFF with pages
gdal_translate -q -ot Float32 -a_srs EPSG:25832 plane.asc utm32.tif
gdal_translate -q -of GPKG -co RASTER_TABLE=ground utm32.tif several.gpkg 2>/dev/null
gdal_translate -q -of GPKG -co APPEND_SUBDATASET=YES -co RASTER_TABLE=canopy utm32.tif several.gpkg 2>/dev/null
expect 1 talus-trn several.gpkg -o bad.tif --no-db
says "holds 2 rasters, expected one: GPKG:several.gpkg:ground, GPKG:several.gpkg:canopy"
name=$(sed -n "s/^ *hint: .* '\(.*\)'$/\1/p" err)
expect 0 talus-trn "$name" -o named.tif
is_plane named.tif 1e-3
talus-runs show 1 >show
grep -q "several.gpkg" show || fail "the registry does not name the file"
expect 1 talus-trn GPKG:several.gpkg:roof -o bad.tif --no-db
expect 1 talus-trn GPKG:missing.gpkg:roof -o bad.tif --no-db
says "there is no such file"
gdal_translate -q utm32.tif pages.tif
gdal_translate -q -co APPEND_SUBDATASET=YES utm32.tif pages.tif
expect 1 talus-trn pages.tif -o bad.tif --no-db
says "holds 2 rasters, expected one: GTIFF_DIR:1:pages.tif, GTIFF_DIR:2:pages.tif"
expect 0 talus-trn GTIFF_DIR:2:pages.tif -o page.tif --no-db
is_plane page.tif 1e-3
nothing_left bad.tif
