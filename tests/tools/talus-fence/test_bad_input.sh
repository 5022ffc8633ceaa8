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
says 'too few arrivals for the percentiles of the code, 3 of '
grep -q '"enough_arrivals": false' f.json || fail 'three arrivals are enough?'
ogrinfo -q -al f.gpkg fence_fields >fields
grep -q 'verdict (String) = too few arrivals' fields || fail 'a field of three arrivals is judged'
printf 'key,value,unit,mark,source\nformula,din,,m,\n' >code.csv
expect 1 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg --code code.csv
says 'expected uni or onr'
expect 2 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg --consequence-class 7
nothing_left g.gpkg
# Another fence than the one that was built, and runs with and without it in one sample.
mkdir with
run-probe with 2 standing=1 seed=1
sed 's/height_m = 3/height_m = 5/' with/site.toml >higher.toml
expect 1 talus-fence higher.toml with/run_0.h5 --trn with/slope.tif -o g.gpkg
says 'with/run_0.h5: was computed with a fence whose fence.check.height_m is 3, expected 5 as in higher.toml'
says 'hint: '
expect 0 talus-fence higher.toml run_0.h5 --trn slope.tif -o virtual.gpkg
sed '/capacity_kj/d' with/site.toml >rigid.toml
expect 1 talus-fence rigid.toml with/run_0.h5 --trn with/slope.tif -o g.gpkg
says 'capacity_kj is 250, expected not given'
expect 1 talus-fence site.toml run_0.h5 with/run_0.h5 --trn slope.tif -o g.gpkg
says 'with/run_0.h5: fence check stood in this run, expected none as in run_0.h5'
# Values without sense, and design codes.
for option in --design-block-m3=-1 --design-block-m3=0 --object-distance-m=-5 --deflection-m=-1 --free-border-m=-0.5; do
  expect 2 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg $option
done
expect 1 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg --code foo
says 'hint: give uni, onr, or a data file'
sed '/gamma_risk/d' "$source_dir/share/codes/uni_11211-4.csv" >code.csv
expect 1 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg --code code.csv
says 'gives no value for gamma_risk'
says 'hint: '
for level in 95 0.97 -0.5; do
  sed "s/^height_percentile,0.95/height_percentile,$level/" "$source_dir/share/codes/uni_11211-4.csv" >code.csv
  expect 1 talus-fence site.toml run_0.h5 --trn slope.tif -o g.gpkg --code code.csv
  says 'height_percentile'
done
nothing_left g.gpkg
# A run that failed among those compared with marks all as well.
run-probe with 1 seed=2 status=failed
expect 0 talus-fence site.toml run_0.h5 --without with/run_0.h5 --trn slope.tif -o d.gpkg --json d.json
says '1 of 2 runs failed its numerical checks: with/run_0 (a limit was broken'
grep -q '"REMARK": "1 of 2 runs failed its numerical checks"' d.json || fail 'the result is not marked'
ogrinfo -so d.gpkg fences | grep -q 'failed its numerical checks' || fail 'the layer is not marked'
