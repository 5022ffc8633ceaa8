# Runs that cannot be mapped are refused before anything is written, with why and the remedy.
run-probe . 2
mkdir other version failed empty half
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
run-probe half 1 status=running seed=9
expect 1 talus-maps half/run_0.h5 --trn slope.tif -o maps
says 'the run is running at 5 of 8 s, expected one that has ended'
says 'let talus-dda finish it (--resume)'
nothing_left maps/reach.tif

# One that failed its health is taken, and every map, legend and picture says so.
expect 0 talus-maps failed/run_0.h5 run_0.h5 --trn slope.tif -o marked --pages png
says '1 of 2 runs failed its numerical checks: failed/run_0 (a limit was broken'
expect 0 talus-maps run_0.h5 --trn slope.tif -o plain --pages png
for name in reach ke_total deposit; do
  gdalinfo "marked/$name.tif" >info
  grep -q 'HEALTH=1 of 2 runs failed its numerical checks: failed/run_0' info || fail "$name is not marked"
  grep -q 'REMARK=1 of 2 runs failed its numerical checks' info || fail "$name has no remark"
  grep -q '1 of 2 runs failed its numerical checks' "marked/$name.qml" || fail "the legend of $name is not marked"
  # a red strip on top of the page, whose pixels have six bits a channel
  [ "$(gdallocationinfo -valonly "marked/$name.png" 5 2 | head -3 | tr '\n' ' ')" = "179 35 31 " ] || fail "the picture of $name is not marked"
  [ "$(gdallocationinfo -valonly "plain/$name.png" 5 2 | head -3 | tr '\n' ' ')" != "179 35 31 " ] || fail "a mark without a failure"
done

expect 0 talus-maps empty/run_0.h5 --trn slope.tif -o nothing
says 'the maps are empty'
gdalinfo -mm nothing/reach.tif | grep -q 'Min/Max=0.000,0.000' || fail 'the empty map is not zero'

printf 'no run' >bad.h5
expect 1 talus-maps bad.h5 --trn slope.tif -o maps
says 'bad.h5'
expect 1 talus-maps missing.h5 --trn slope.tif -o maps
says 'no such file'
expect 2 talus-maps run_0.h5 --trn slope.tif -o maps --resamples 300
says "is always drawn 200 times"
expect 2 talus-maps --trn slope.tif -o maps

for value in "--cell-size-m -8" "--memory-mb -1"; do
  expect 2 talus-maps run_0.h5 --trn slope.tif -o refused $value
  says 'out of range'
done
nothing_left refused
