# Runs with the fence beside runs without: a block that crossed a built fence came through.
mkdir with without
run-probe with 3 standing=1
run-probe without 3 seed=1
expect 0 talus-fence with/site.toml with/run_*.h5 --without without/run_0.h5 without/run_1.h5 without/run_2.h5 --trn with/slope.tif -o fence.gpkg --json fence.json
grep -q '"standing": true' fence.json || fail 'the fence did not stand'
prints '3 pierced'
grep -q '"with_minus_without"' fence.json || fail 'no comparison'
expect 0 talus-fence without/site.toml without/run_0.h5 --without with/run_0.h5 --trn with/slope.tif -o b.gpkg
says 'did not stand in the runs compared'
