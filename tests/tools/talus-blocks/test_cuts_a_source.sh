# A source is cut: all outputs are written, volumes agree with the prism sum, the bed lies below it.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
expect 0 blocks --report r.json --footprints f.gpkg --trn-out bed.tif --stereonet net.svg \
  --size-curve size.svg
prints " blocks, "
for file in blocks.h5 r.json f.gpkg bed.tif net.svg size.svg; do
  [ -s "$file" ] || fail "$file is missing"
done
n=$(value r.json n_blocks)
[ "$n" -eq "$(ogrinfo -so f.gpkg blocks | sed -n 's/Feature Count: //p')" ] || fail "not one footprint a block"
holds "$(value r.json volume_error) < 1e-9 && $(value r.json volume_error) > -1e-9"
holds "$(value r.json convexified_change) < 0.01 && $(value r.json convexified_change) > -0.02"
# the terrain is lowered below all of the polygon and comes back to the ground beside it, so more
# lies between the two than the mass, by less than a cell all around
gdal_calc=$(command -v gdal_calc.py || true)
if [ -n "$gdal_calc" ]; then
  "$gdal_calc" --quiet -A trn.tif -B bed.tif --calc "A-B" --outfile depth.tif --type Float64 --NoDataValue=-9999
  mean=$(gdalinfo -stats depth.tif | sed -n 's/.*STATISTICS_MEAN=//p')
  volume=$(value r.json prism_volume_m3)
  holds "$mean * 576 * 4 > $volume && $mean * 576 * 4 < $volume * 26 * 26 / (22 * 22)"
fi

# the sloping local base level: its limits and its volume are reported
expect 0 blocks --overwrite --report slbl.json --set source.failure_surface=slbl \
  --set source.slbl_curvature_m=0.05 --set source.slbl_max_depth_m=3
holds "$(value slbl.json slbl_curvature_m) == 0.05 && $(value slbl.json slbl_max_depth_m) == 3"
holds "$(value slbl.json prism_volume_m3) > 0 && $(value slbl.json largest_depth_m) < 3 + 1e-9"
