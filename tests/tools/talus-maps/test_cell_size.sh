# Whole multiples of the recorded cells are exact; other sizes are refused with a remedy.
run-probe . 1
expect 0 talus-maps run_0.h5 --trn slope.tif -o coarse --cell-size-m 4
expect 0 talus-maps run_0.h5 --trn slope.tif -o own
gdalinfo coarse/velocity.tif | grep -q 'Pixel Size = (4.0' || fail 'the cells are not 4 m'
# the maximum of the whole path is the same, the cells are a quarter as many and a bit more
for folder in coarse own; do
  gdalinfo -mm "$folder/velocity.tif" | grep -m1 'Computed Min/Max' | sed 's/.*,//' >"$folder.max"
done
cmp coarse.max own.max || fail 'the largest speed depends on the cell size'
expect 1 talus-maps run_0.h5 --trn slope.tif -o odd --cell-size-m 3
says 'expected a whole multiple of 2'
says 'cell_size_m = 3'
nothing_left odd/reach.tif
