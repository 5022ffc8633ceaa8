# Two objects in line are both hit; with a fence between them the first alone.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
sed -i 's/^duration_s = .*/duration_s = 10/' site.toml
cat >>site.toml <<'END'
[object.upper]
polygon = [[500040, 5000020], [500045, 5000020], [500045, 5000080], [500040, 5000080]]
[object.lower]
polygon = [[500080, 5000020], [500085, 5000020], [500085, 5000080], [500080, 5000080]]
END
make_blocks
expect 0 run_dda -o open.h5
expect 0 run_dda -o standing.h5 --set fence.low.active=true
expect 0 talus-trace site.toml open.h5 --trn slope.tif -o open.gpkg --csv open.csv --no-db
prints 'upper: hit by 100 % of the rocks, 3 blocks'
prints 'lower: hit by 100 % of the rocks, 3 blocks'
expect 0 talus-trace site.toml standing.h5 --trn slope.tif -o standing.gpkg --csv standing.csv --no-db
prints 'upper: hit by 100 % of the rocks, 3 blocks'
prints 'lower: hit by 0 % of the rocks'
# hits of the first object are the same in both
grep upper open.csv >a && grep upper standing.csv >b && cmp a b || fail 'the fence changes what comes to the object above it'
