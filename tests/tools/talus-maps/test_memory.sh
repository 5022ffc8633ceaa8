# Maps made in many tiles, each from its own reading of the runs, hold the same bits as made at once.
run-probe . 12 blocks=2
expect 0 talus-maps run_*.h5 --trn slope.tif -o whole --min-passages 2
expect 0 talus-maps run_*.h5 --trn slope.tif -o tiled --min-passages 2 --memory-mb 0.005  # 56 rows
for name in reach velocity ke_total pass_height_top exceedance deposit arrival energy_line; do
  for folder in whole tiled; do gdal_translate -q -of ENVI "$folder/$name.tif" "$folder.raw"; done
  cmp whole.raw tiled.raw || fail "$name depends on the memory allowed"
done
expect 0 talus-maps run_*.h5 --trn slope.tif -o coarse --cell-size-m 4
expect 0 talus-maps run_*.h5 --trn slope.tif -o coarse_tiled --cell-size-m 4 --memory-mb 0.005
for folder in coarse coarse_tiled; do gdal_translate -q -of ENVI "$folder/ke_total.tif" "$folder.raw"; done
cmp coarse.raw coarse_tiled.raw || fail 'tiles of coarser cells differ'
expect 2 talus-maps run_0.h5 --trn slope.tif -o none --memory-mb -1
