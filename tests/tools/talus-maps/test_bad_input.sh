# What cannot be mapped is refused before anything is written, saying why and what to do.
run-probe . 2
mkdir other version failed empty
run-probe other 1 site=elsewhere seed=5
run-probe version 1 version=9.9.9 seed=6
run-probe failed 1 status=failed seed=7
run-probe empty 1 empty=1 seed=8

expect 1 talus-maps run_0.h5 other/run_0.h5 --trn slope.tif -o maps
says 'the site is elsewhere, expected probe'
expect 1 talus-maps run_0.h5 version/run_0.h5 --trn slope.tif -o maps
says 'version of the program is 9.9.9'
expect 1 talus-maps run_0.h5 run_0.h5 --trn slope.tif -o maps
says 'is the same run as'
gdal_translate -q -a_nodata -1 slope.tif another.tif
expect 1 talus-maps run_0.h5 --trn another.tif -o maps
says 'computed on another terrain'
expect 1 talus-maps failed/run_0.h5 --trn slope.tif -o maps
says 'the run is failed: a limit was broken'
says '--allow-unfinished'
nothing_left maps/reach.tif
expect 0 talus-maps failed/run_0.h5 --trn slope.tif -o marked --allow-unfinished
says '1 of 1 run unfinished or failed'
for name in reach ke_total deposit; do
  gdalinfo "marked/$name.tif" | grep -q 'UNFINISHED OR FAILED' || fail "$name is not marked"
  grep -q 'unfinished or failed' "marked/$name.qml" || fail "the legend of $name is not marked"
done

expect 0 talus-maps empty/run_0.h5 --trn slope.tif -o nothing
says 'the maps are empty'
gdalinfo -mm nothing/reach.tif | grep -q 'Min/Max=0.000,0.000' || fail 'the empty map is not zero'

printf 'no run' >bad.h5
expect 1 talus-maps bad.h5 --trn slope.tif -o maps
says 'bad.h5'
expect 1 talus-maps missing.h5 --trn slope.tif -o maps
says 'no such file'
expect 2 talus-maps run_0.h5 --trn slope.tif -o maps --resamples 3
expect 2 talus-maps --trn slope.tif -o maps

for value in "--rest-speed-m-s nan" "--cell-size-m -8" "--memory-mb 0"; do
  expect 2 talus-maps run_0.h5 --trn slope.tif -o refused $value
  says 'out of range'
done
nothing_left refused
