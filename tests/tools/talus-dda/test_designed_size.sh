# The designed slide's run file, 39 blocks for 20 s with default output, stays below 2 MB. Contacts
# between blocks do not change how much is written, so each block moves alone, which is quick.
site=$source_dir/sample_sites/designed
cp "$site/site.toml" "$site/contours.gpkg" .
expect 0 talus-tin contours.gpkg -o tin.ply --elevation-field elevation_m
expect 0 talus-trn tin.ply -o trn.tif --cell-size-m 8 --window 500000,5200000,500224,5200320
expect 0 talus-blocks site.toml --trn trn.tif -o blocks.h5 --trn-out bed.tif
code=0
talus-dda site.toml --trn bed.tif --blocks blocks.h5 -o run.h5 --set solver.blocks=alone >out 2>err || code=$?
[ "$code" = 0 ] || [ "$code" = 3 ] || fail "exit code $code"
size=$(wc -c <run.h5)
[ "$size" -lt 2000000 ] || fail "run.h5 has $size bytes"
[ "$size" -gt 100000 ] || fail "run.h5 has $size bytes: is anything in it?"
