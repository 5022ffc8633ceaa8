# Runs that cannot be reduced are refused; no half of a part is ever there.
run-probe . 3
expect 0 talus-reduce run_0.h5 run_1.h5 --trn slope.tif -o part.h5
expect 1 talus-reduce part.h5 run_1.h5 --trn slope.tif -o both.h5
says 'is the same run as'
says 'part.h5 (test_bad_input/run_1.h5)'
expect 1 talus-reduce part.h5 part.h5 --trn slope.tif -o both.h5
says 'is the same run as'
expect 1 talus-maps part.h5 run_0.h5 --trn slope.tif -o maps
says 'is the same run as'
expect 2 talus-reduce part.h5 --trn slope.tif -o part.h5
says 'is both an input and an output'
mkdir other
run-probe other 1 site=elsewhere seed=5
expect 1 talus-reduce part.h5 other/run_0.h5 --trn slope.tif -o both.h5
says 'the site is elsewhere, expected probe'
# lengths of paths were measured when there were frames
expect 1 talus-reduce part.h5 run_2.h5 --trn slope.tif -o both.h5 --path-tolerance-m 0.1
says 'give --path-tolerance-m 0.5'
expect 1 talus-runout part.h5 --trn slope.tif -o r.gpkg --path-tolerance-m 0.1
says 'give --path-tolerance-m 0.5'
# sealed: a part that was changed is not opened
cp part.h5 damaged.h5
printf 'x' | dd of=damaged.h5 bs=1 seek=3000 conv=notrunc 2>/dev/null
expect 1 talus-maps damaged.h5 --trn slope.tif -o maps
says 'is damaged'
nothing_left both.h5 maps/reach.tif r.gpkg
expect 2 talus-reduce --trn slope.tif -o none.h5
says 'run is required'

# Those of a folder, beside which parts do not count
mkdir folder
cp run_0.h5 run_1.h5 run_2.h5 folder
expect 0 talus-reduce folder --trn slope.tif -o of_folder.h5
expect 0 talus-reduce folder/run_0.h5 folder/run_1.h5 folder/run_2.h5 --trn slope.tif -o named.h5
cmp of_folder.h5 named.h5 || fail 'a folder gives another part'
mkdir none
expect 1 talus-maps none --trn slope.tif -o maps
says 'holds no run'
nothing_left maps/reach.tif
