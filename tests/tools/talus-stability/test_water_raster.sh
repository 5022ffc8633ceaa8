# Water by a raster: one in another projection is doubted by the import and refused, with the command
# that brings it to the terrain's; after that the factor is that of the same plane by three points.
# Parts that the raster does not cover are doubted, all of the mass refused, an undeclared nodata
# value found.
. "$source_dir/tests/tools/talus-dda/common.sh"
command -v gdalwarp >/dev/null || skip "needs gdal-bin"
make_terrain
cat >site.toml <<'TOML'
[terrain]
dem = "slope.tif"
[source]
polygon = [[500041, 5000031], [500069, 5000031], [500069, 5000058], [500041, 5000058]]
failure_surface = "plane"
plane_dip_deg = 25
plane_dip_direction_deg = 90
plane_point_m = [500070, 5000045, 959.585]
min_block_volume_m3 = 5
[joints.rear]
dip_deg = 90
dip_direction_deg = 90
spacing_m = 9
[joints.lateral]
dip_deg = 90
dip_direction_deg = 0
spacing_m = 9
[material.rock]
friction_deg = 30
[ground.rock]
friction_deg = 30
TOML
expect 0 talus-blocks site.toml --trn slope.tif -o blocks.h5 --trn-out bed.tif -q --no-db
# head NAME X_LAST: z = 998.5 - 0.577 (x - 500000) up to the column X_LAST, -9999 beyond it
heads() {
  awk -v last="$2" 'BEGIN {
    print "ncols 61\nnrows 61\nxllcenter 499990\nyllcenter 4999980\ncellsize 2.5\nNODATA_value " (last > 60 ? -1 : -9999)
    for (r = 0; r < 61; r++) {
      line = ""
      for (c = 0; c < 61; c++) line = line " " (c > last ? -9999 : sprintf("%.6f", 998.5 - (2.5 * c - 10) * 0.577))
      print line
    }
  }' >"$1.asc"
  gdal_translate -q -a_srs EPSG:32632 "$1.asc" "$1.tif"
}
with() { sed '/^\[water\]/,$d' site.toml >"$1.toml" && printf '[water]\ndrained = ["rear", "lateral", "source_side"]\n%s\n' "$2" >>"$1.toml"; }
stability() { talus-stability "$1.toml" --trn bed.tif --blocks blocks.h5 --no-db --overwrite -o "$1"; }
factor() { python3 -c "import json; print(json.load(open('$1/stability.json'))['groups'][0]['factor']['factor'])"; }

heads here 99
gdalwarp -q -t_srs EPSG:32633 -r cubic -tr 2.5 2.5 -dstnodata -9999 here.tif there.tif
with there 'raster = "there.tif"'
expect 0 talus-import there.toml -o inputs.gpkg --report import.json
says "there.tif: the raster is in EPSG:32633"
prints "water.raster: "
grep -q '"doubts": \[' import.json || fail "the report of the import has no doubt"
expect 1 stability there
says "hint: a raster is never reprojected silently: gdalwarp"
eval "$(sed -n 's/.*never reprojected silently: //p' err)"
with there 'raster = "in_system.tif"'
expect 0 talus-import there.toml -o inputs.gpkg --overwrite
if grep -q 'the raster is in' err; then fail "the command did not help: $(cat err)"; fi
expect 0 stability there
with plane 'surface_m = [[500000, 5000000, 998.5], [500100, 5000000, 940.8], [500000, 5000100, 998.5]]'
expect 0 stability plane
python3 -c "assert abs($(factor there) / $(factor plane) - 1) < 0.01, ($(factor there), $(factor plane))" || fail "another factor"

heads part 26  # to x = 500055
with part 'raster = "part.tif"'
expect 0 stability part
says "part.tif: water.raster: is unknown at"
heads none 10
with none 'raster = "none.tif"'
expect 1 stability none
says "is unknown over the whole mass"
gdal_translate -q -a_nodata none part.tif undeclared.tif
with undeclared 'raster = "undeclared.tif"'
expect 1 stability undeclared
says "-9999"
