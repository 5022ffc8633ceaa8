# A part replaces its runs: the same result without them, but for the animation.
mkdir site
run-probe site 6 blocks=2
mkdir -p site/out/runs site/out/parts
cp site/slope.tif site/out/trn.tif
mv site/run_*.h5 site/out/runs/
expect 0 talus-runout site/out/runs/run_*.h5 --trn site/out/trn.tif -o site/out/runout.gpkg --json site/out/runout.json --no-db
expect 0 talus-report site/site.toml --dir site/out -o site/out/report.html --no-db
facts() { sed -n '/class="facts"/,/^<\/div>/p' site/out/report.html; }
facts >facts.of_runs
grep -q 'id="viewer"' site/out/report.html || fail 'no animation of a run with frames'
expect 0 talus-reduce site/out/runs/run_0.h5 site/out/runs/run_1.h5 site/out/runs/run_2.h5 --trn site/out/trn.tif -o site/out/parts/a.h5 --no-db
expect 0 talus-reduce site/out/runs/run_3.h5 site/out/runs/run_4.h5 site/out/runs/run_5.h5 --trn site/out/trn.tif -o site/out/parts/b.h5 --no-db
# a run that is kept whole is the one that is shown
rm site/out/runs/run_[1-5].h5
expect 0 talus-report site/site.toml --dir site/out -o site/out/report.html --no-db --overwrite
facts >facts.of_parts
cmp facts.of_runs facts.of_parts || fail 'the result of parts is another one'
grep -q 'Run 0, the one of the farthest' site/out/report.html || fail 'the run with frames is not shown'
rm site/out/runs/run_0.h5
expect 0 talus-report site/site.toml --dir site/out -o site/out/report.html --no-db --overwrite
facts >facts.of_parts
cmp facts.of_runs facts.of_parts || fail 'the result of parts alone is another one'
grep -q 'id="viewer"' site/out/report.html && fail 'an animation without frames'
grep -q 'which has no frames between start and end' site/out/report.html || fail 'the plan does not say that it has no frames'
rm site/out/parts/b.h5
expect 1 talus-report site/site.toml --dir site/out -o site/out/report.html --no-db --overwrite
says 'holds 3 of the 6 runs that runout.json is made from, those of parts/ counted'
