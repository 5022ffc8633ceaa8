# Few failed runs are left out, listed and counted into the intervals; of more, every output says so.
mkdir failed more
run-probe . 100
run-probe failed 2 status=failed seed=7
expect 0 talus-maps run_*.h5 --trn slope.tif -o good
expect 0 talus-maps run_*.h5 failed/run_*.h5 --trn slope.tif -o few --pages png --json
cp out few.json
says '2 of 102 runs failed their numerical checks and are left out: failed/run_0 (a limit was broken'
python3 - <<'PY' || fail 'the failed runs are not listed'
import json
j = json.load(open('few.json'))
assert j['n_runs'] == 100 and j['failed_runs'] == [], j
assert [(r['run'], r['seed']) for r in j['left_out_runs']] == [('failed/run_0', 0), ('failed/run_1', 0)], j
assert 'a limit was broken' in j['left_out_runs'][0]['reason']
PY
gdalinfo few/reach.tif >info
for tag in N_RUNS=100 N_FAILED=2 N_LEFT_OUT=2; do grep -q "$tag\$" info || fail "no tag $tag"; done
grep -q 'REMARK' info && fail 'few failed runs are marked like many'
# probabilities are those of the rest; intervals are for all: [R (1 - f), R (1 - f) + f]
gdal_translate -q -of XYZ -b 2 few/reach.tif few.xyz
gdal_translate -q -of XYZ -b 2 good/reach.tif good.xyz
cmp few.xyz good.xyz || fail 'the failed runs are in the shares'
for band in 3 4; do
  for side in few good; do gdal_translate -q -of XYZ -b $band $side/reach.tif ${side}_$band.xyz; done
  paste few_$band.xyz good_$band.xyz | awk -v add=$((band - 3)) '$3 != -9999 {
    f = 2 / 102; wanted = $6 * (1 - f) + add * f
    if ($3 - wanted > 1e-6 || wanted - $3 > 1e-6) { print; bad = 1 }; ++n }
    END { exit bad || n == 0 }' || fail "band $band does not count the failed runs"
done
bound() { sed -n 's/ *REACH_UPPER_BOUND_ELSEWHERE=//p'; }
gdalinfo good/reach.tif | bound >good.bound
[ "$(cat good.bound)" = 0.0369935 ] || fail "the bound elsewhere is $(cat good.bound)"
bound <info | awk '{ wanted = 0.0369935 * 100 / 102 + 2 / 102; exit $1 - wanted > 1e-6 || wanted - $1 > 1e-6 }' || fail 'the bound elsewhere does not count the failed runs'
# the same from a part that holds the failed runs too
expect 0 talus-reduce run_*.h5 failed/run_*.h5 --trn slope.tif -o part.h5
expect 0 talus-maps part.h5 --trn slope.tif -o of_part --pages png
for file in few/*.tif few/*.qml few/*.png; do cmp "$file" "of_part/${file#few/}" || fail "$file of a part is another one"; done
expect 0 talus-runout run_*.h5 failed/run_*.h5 --trn slope.tif -o a.gpkg --json a.json
expect 0 talus-runout part.h5 --trn slope.tif -o b.gpkg --json b.json
for side in a b; do ogr2ogr -f CSV $side.csv $side.gpkg envelope -lco GEOMETRY=AS_WKT; done
cmp a.csv b.csv || fail 'cells of failed runs are in the envelope of a part'
# as many missing runs: the same intervals
mkdir wanted
cp run_*.h5 wanted
expect 0 talus-maps wanted --trn slope.tif -o all
python3 - <<'PY'
import json
e = json.load(open('wanted/ensemble.json'))
e['planned'] = True
for seed in 100, 101:
    e['members'].append({**e['members'][0], 'file': 'run_%d.h5' % seed, 'seed': seed, 'digest': '', 'run_id': '',
                         'outcome': 'not started'})
json.dump(e, open('wanted/ensemble.json', 'w'))
PY
expect 0 talus-maps wanted --trn slope.tif -o missing
for side in few missing; do gdal_translate -q -of XYZ -b 4 $side/reach.tif $side.xyz; done
cmp few.xyz missing.xyz || fail 'missing runs count for less than failed ones'
gdalinfo missing/reach.tif | grep -q REMARK && fail 'few missing runs are marked like many'
# one more than the share allows
run-probe more 1 status=failed seed=9
expect 0 talus-maps run_*.h5 failed/run_*.h5 more/run_0.h5 --trn slope.tif -o many
says '3 of 103 runs failed their numerical checks'
gdalinfo many/reach.tif | grep -q 'REMARK=3 of 103 runs failed' || fail 'many failed runs are not marked'
mkdir allows
run-probe allows 100 share=0.03
mkdir allows/failed
run-probe allows/failed 3 status=failed seed=7 share=0.03
expect 0 talus-maps allows --trn slope.tif -o allowed
gdalinfo allowed/reach.tif | grep -q 'N_LEFT_OUT=3' || fail 'the share that is allowed is not taken'
