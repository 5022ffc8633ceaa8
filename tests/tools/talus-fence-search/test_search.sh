# A fence is proposed, is built in other runs, and lets through as much as predicted.
. "$source_dir/tests/tools/talus-fence-search/common.sh"
make_search
runs run 1 12
expect 0 search run_*.h5 -o search.gpkg --json search.json --proposals proposals --charts charts
prints 'house: house is hit in 12 of 12 runs; cheapest fence house-1: '
prints 'not verified'
[ -s charts/fence_search_house.svg ] || fail 'no chart'
for layer in candidates front proposals posts; do ogrinfo -q search.gpkg | grep -q "$layer" || fail "no layer $layer"; done
cat >check.py <<'PY'
import json
s = json.load(open('search.json'))['searches'][0]
assert s['verdict'] == 'fence' and s['n_runs'] == s['n_runs_hit'] == 12 and s['run_share'] == 1
assert s['hits_a_run'] == 3 and s['n_candidates'] >= 3, s['n_candidates']
best = s['proposals'][0]
assert best['lacks'] == [] and best['stopped_share'] >= 0.95 and best['verified'] is None
fence = best['fences'][0]
assert fence['height_m'] >= fence['needed_height_m'] and fence['capacity_kj'] >= fence['needed_capacity_kj']
assert fence['capacity_kj'] >= fence['field_energy_one_second_kj']
# the boxes come down at y = 30 to 70: a free field at each end
ys = [p[1] - 5000000 for p in best['lines'][0]['posts']]
assert min(ys) <= 21 and max(ys) >= 79, ys
assert all(a['cost'] <= b['cost'] for a, b in zip(s['curve'], s['curve'][1:]))
assert all(a['stopped_share'] < b['stopped_share'] for a, b in zip(s['curve'], s['curve'][1:]))
PY
python3 check.py || fail 'the search says something else'

# the same in any order, and from a part, which has no frames to refine with
expect 0 search run_9.h5 run_1[012].h5 run_[1-8].h5 -o again.gpkg --json again.json --proposals again --charts again_charts
cmp search.json again.json && cmp search.gpkg again.gpkg && cmp proposals/house-1.toml again/house-1.toml || fail 'the order of runs counts'
expect 0 search run_*.h5 -o plain.gpkg --json plain.json --no-refine
expect 0 talus-reduce run_*.h5 --trn slope.tif -o part.h5 --no-db
expect 0 search part.h5 -o part.gpkg --json part.json
says 'fences are not refined'
for file in plain part; do sed '/"run_id"\|RUN_ID\|"warnings"/d' $file.json >$file.txt; done
python3 - <<'PY' || fail 'a part gives other fences than its runs'
import json
a, b = (json.load(open(f + '.json'))['searches'] for f in ('plain', 'part'))
assert a == b
PY

# pieces would count beside the block that they are part of
printf '[variant.broken]\nweight = 1\n[variant.rare]\nweight = 1\n[variant.often]\nweight = 1\n' >>site.toml
runs run_broken 13 14 --variant broken --set fragmentation.enabled=true --set fragmentation.energy_j_m2=1e4
expect 0 search run_*.h5 -o broken.gpkg --json broken.json
says 'blocks broke in some runs: fences are not refined'
rm run_broken_*.h5

# it is built in other runs
runs other 101 112 --add proposals/house-1.toml
mkdir verify
cp other_*.h5 verify
expect 0 search run_*.h5 -o verified.gpkg --json verified.json --verified house-1=verify
prints 'with the fence standing and 12 other runs: 0 %'
prints 'as predicted'
grep -q '"best": "house-1"' verified.json || fail 'what holds is not the best'

# and its own section, for the design check
expect 0 talus-fence site.toml --add proposals/house-1.toml other_*.h5 --trn slope.tif -o fence.gpkg --no-db
prints 'fence house-1'

# runs of two classes count by how often these happen: 0.01 and 0.04 a year, only the rare one hits
runs rare 1 12 --variant rare
runs often 1 6 --variant often --set solver.duration_s=1
sed 's/^\[fence_search/[hazard]\n[hazard.class.rare]\nfrequency_per_a = 0.01\n[hazard.class.often]\nfrequency_per_a = 0.04\n&/' \
  site.toml >classes.toml
expect 0 talus-fence-search classes.toml rare_*.h5 often_*.h5 --trn slope.tif --no-db \
  -o classes.gpkg --json classes.json --no-refine
python3 - <<'PY' || fail 'classes do not count by their frequency'
import json
s = json.load(open('classes.json'))['searches'][0]
assert abs(s['run_share'] - 0.2) < 1e-12, s['run_share']
assert abs(s['hit_per_a'][0] - 0.01) < 1e-12 and abs(s['hits_a_run'] - 0.6) < 1e-12, s
PY

# rocks weigh as much as they fall a year; their hits are counted, as talus-trace counts them
sed -e 's/^\[blocks.a\]/[rockfall.a]\nrocks = 2\nfrequency_per_a = 0.3/' -e '/^spin_rad_s/d' classes.toml |
  sed '/^\[hazard.class/,/^frequency_per_a/d; s/^\[hazard\]/&\n[hazard.class.all]/' >rocks.toml
expect 0 talus-blocks rocks.toml --trn slope.tif -o rocks.h5 -q --no-db
expect 0 talus-dda rocks.toml --trn slope.tif --blocks rocks.h5 -o rocks_1.h5 --no-db
expect 0 talus-trace rocks.toml rocks_1.h5 --trn slope.tif -o trace.gpkg --json trace.json --no-db
expect 0 talus-fence-search rocks.toml rocks_1.h5 --trn slope.tif --no-db -o rocks.gpkg --json rocks.json --no-refine
python3 - <<'PY' || fail 'hits are not counted'
import json
traced, = json.load(open('trace.json'))['objects']
s = json.load(open('rocks.json'))['searches'][0]
assert s['hits_a_run'] == traced['hits_a_run'] == 6, (s['hits_a_run'], traced['hits_a_run'])
PY

# a built fence is reported
expect 0 search other_101.h5 other_102.h5 -o standing.gpkg
says 'fences stood in the runs: house-1'

# nothing hits an object that lies aside
sed -e 's/^polygon = .*/polygon = [[500085, 5000001], [500095, 5000001], [500095, 5000009], [500085, 5000009]]/' \
  -e 's/^protect/min_fields = 1\nend_fields = 0\nprotect/' site.toml >aside.toml
mv aside.toml site.toml
runs aside 1 2
expect 0 search aside_*.h5 -o aside.gpkg --json aside.json
prints 'nothing hits house in 2 runs: no fence is the best'
grep -q '"verdict": "none needed"' aside.json || fail 'a fence that nobody needs'
