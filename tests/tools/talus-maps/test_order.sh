# Runs in any order, and any interval of frames, give the same bytes.
run-probe . 4 blocks=2
expect 0 talus-maps run_0.h5 run_1.h5 run_2.h5 run_3.h5 --trn slope.tif -o a --min-passages 2 --png
expect 0 talus-maps run_3.h5 run_1.h5 run_0.h5 run_2.h5 --trn slope.tif -o b --min-passages 2 --png
for file in a/*.tif a/*.qml a/*.png; do
  cmp "$file" "b/${file#a/}" || fail "$file depends on the order of the runs"
done
mkdir fine
run-probe fine 4 blocks=2 frames=0.003
expect 0 talus-maps fine/run_*.h5 --trn fine/slope.tif -o c --min-passages 2
for name in reach velocity ke_total pass_height_top exceedance deposit arrival energy_line; do
  gdal_translate -q -of AAIGrid -b 1 "a/$name.tif" a.asc
  gdal_translate -q -of AAIGrid -b 1 "c/$name.tif" c.asc
  cmp a.asc c.asc || fail "$name depends on the interval of frames"
done
