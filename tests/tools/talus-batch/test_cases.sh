# Cases lie in folders of their own, are weighed, and each is evaluated alone.
. "$source_dir/tests/tools/talus-batch/common.sh"
cp site.toml plain.toml
# weights SOFT: the alternatives with this weight of one
weights() {
  { cat plain.toml && printf '[variant.soft]\nweight = %s\nground.ground.friction_deg = 10\n[variant.hard]\nweight = 1\n' "$1"; } >site.toml
}
weights 3
set -- --runs 2 -- --set solver.blocks=alone
made_again 4 "$@"
for file in soft/run_1.h5 hard/run_2.h5 ensemble.json soft/ensemble.json; do
  [ -s "results/runs/$file" ] || fail "no $file"
done
made_again 0 "$@"
python3 - <<'PY' || fail "the ensemble says something else of its cases"
import json
e = json.load(open('results/runs/ensemble.json'))
assert e['weights'] == {'hard': 1, 'soft': 3}, e['weights']
assert [m['weight'] for m in e['members']] == [1.5, 1.5, .5, .5], e['members']
assert 'case soft: ground.ground.friction_deg = 10; case hard: 20' in e['settings_that_differ'], e
assert len(json.load(open('results/runs/soft/ensemble.json'))['members']) == 2
PY
expect 0 talus-maps results/runs --trn results/bed.tif -o maps --no-db
gdalinfo maps/reach.tif | grep -q 'CASES=hard 0.25 (2 runs), soft 0.75 (2 runs)' || fail "cases are not weighed"
expect 0 talus-maps results/runs/soft --trn results/bed.tif -o soft --no-db
gdalinfo soft/reach.tif | grep -q 'N_RUNS=2$' || fail "a case is not evaluated by itself"
weights 1
made_again 0 "$@"
expect 0 talus-maps results/runs --trn results/bed.tif -o maps --overwrite --no-db
gdalinfo maps/reach.tif | grep -q 'CASES=hard 0.5 (2 runs), soft 0.5 (2 runs)' || fail "another weight does not count"
expect 2 batch --case soft= "$@"
says "write a section [variant.NAME] with a weight in the site file"
