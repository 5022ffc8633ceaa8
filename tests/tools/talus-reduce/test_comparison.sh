# With and without a fence, and the change between them: the same from parts as from runs.
mkdir with without
run-probe with 6 blocks=2 standing=1 hits=broken
run-probe without 6 blocks=2 seed=3
for side in with without; do
  expect 0 talus-reduce $side/run_*.h5 --trn with/slope.tif -o $side.h5
done
expect 0 talus-fence with/site.toml with/run_*.h5 --without without/run_*.h5 --trn with/slope.tif -o a.gpkg --json a.json --csv a.csv --change a.tif
expect 0 talus-fence with/site.toml with.h5 --without without.h5 --trn with/slope.tif -o b.gpkg --json b.json --csv b.csv --change b.tif
cmp a.csv b.csv && cmp a.json b.json || fail 'verdicts of parts are others'
for side in a b; do gdal_translate -q -of ENVI $side.tif $side.raw; done
cmp a.raw b.raw || fail 'the change of parts is another one'

# hits of a built fence that recorded nothing are known from frames alone
mkdir old
run-probe old 2 standing=1 seed=8
expect 0 talus-reduce old/run_*.h5 --trn old/slope.tif -o old.h5
expect 1 talus-fence old/site.toml old.h5 --trn old/slope.tif -o c.gpkg
says 'old.h5 (old/run_0.h5)'
says 'has no frames'
