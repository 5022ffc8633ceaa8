# A raster of depths is the mass with failure_surface "thickness"; taken for the other it is refused.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
volume() { value out prism_volume_m3; }
awk 'BEGIN {
  print "ncols 24\nnrows 24\nxllcenter 500000\nyllcenter 5200000\ncellsize 2\nNODATA_value -9999"
  for (r = 0; r < 24; r++) { line = ""; for (c = 0; c < 24; c++) line = line " " (c < 4 ? -9999 : 3 + 0.125 * c); print line } }' >depth.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 depth.asc depth.tif
awk 'NR == FNR { if (FNR > 6) for (c = 1; c <= NF; ++c) d[FNR, c] = $c; next }
  FNR > 6 { for (c = 1; c <= NF; ++c) $c = d[FNR, c] == -9999 ? -9999 : sprintf("%.6f", $c - d[FNR, c]) } 1' depth.asc slope.asc >surface.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 surface.asc surface.tif
given() { # given KIND RASTER
  sed "s/^failure_surface.*/failure_surface = \"$1\"\nraster = \"$2\"/; /^depth_m/d" site.toml >given.toml
}
given thickness depth.tif
expect 0 talus-blocks given.toml --trn trn.tif -o blocks.h5 --no-db --json
thickness=$(volume)
given raster surface.tif
expect 0 talus-blocks given.toml --trn trn.tif -o blocks.h5 --no-db --json --overwrite
holds "($thickness / $(volume) - 1) ^ 2 < 1e-12"
holds "($thickness / (22 * 22 * (3 + 0.125 * 11.5)) - 1) ^ 2 < 1e-4"
given raster depth.tif
expect 1 talus-blocks given.toml --trn trn.tif -o bad.h5 --no-db
says "these are depths, expected elevations of the surface"
says 'hint: for depths of the mass set source.failure_surface = "thickness"'
given thickness surface.tif
expect 1 talus-blocks given.toml --trn trn.tif -o bad.h5 --no-db
says "these are elevations, expected depths of the mass"
given thickness ""
expect 1 talus-blocks given.toml --trn trn.tif -o bad.h5 --no-db
says 'failure_surface = "thickness" needs raster'
nothing_left bad.h5
