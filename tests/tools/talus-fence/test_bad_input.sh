# A fence that is none, one that the runs did not record, percentiles from too few arrivals.
run-probe . 3
sed 's/350020/390020/' site.toml >far.toml
expect 1 talus-fence far.toml run_0.h5 --trn slope.tif -o f.gpkg
says 'leaves the known terrain'
says 'far.toml:4'
sed 's/250030, 350020/250040, 350020/' site.toml >moved.toml
expect 1 talus-fence moved.toml run_0.h5 --trn slope.tif -o f.gpkg
says 'recorded another line for fence check'
sed 's/fence.check/fence.later/' site.toml >later.toml
expect 1 talus-fence later.toml run_0.h5 --trn slope.tif -o f.gpkg
says 'recorded no line for fence later'
printf '[site]\nname = "probe"\n' >none.toml
expect 1 talus-fence none.toml run_0.h5 --trn slope.tif -o f.gpkg
says 'has no section [fence.*]'
sed 's/, \[250030, 350020\]//' site.toml >point.toml
expect 1 talus-fence point.toml run_0.h5 --trn slope.tif -o f.gpkg
nothing_left f.gpkg
expect 0 talus-fence site.toml run_0.h5 run_1.h5 run_2.h5 --trn slope.tif -o f.gpkg --json f.json
says '3 arrivals are too few'
grep -q '"enough_arrivals": false' f.json || fail 'three arrivals are enough?'
ogrinfo -q -al f.gpkg fence_fields >fields
grep -q 'verdict (String) = too few arrivals' fields || fail 'a field of three arrivals is judged'
printf 'key,value,unit,mark,source\nformula,din,,m,\n' >code.csv
expect 1 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg --code code.csv
says 'expected uni or onr'
expect 2 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg --consequence-class 7
nothing_left g.gpkg
