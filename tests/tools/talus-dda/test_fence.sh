# Active fences: rigid, yielding, broken; which are refused; the slope as fixed blocks.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
line='line = [[500060, 5000010], [500060, 5000090]]'

# rigid: nothing comes through
sed 's/active = false/cor = 0.2/' site.toml >rigid.toml
expect 0 talus-dda rigid.toml --trn slope.tif --blocks blocks.h5 -o rigid.h5 --no-db --json
cp out rigid.json
prints '"n_crossings": 0'
prints '"broken": false'
expect 0 talus-dda rigid.toml --trn slope.tif --blocks blocks.h5 --no-db --plan
prints 'on   standing fences: 1 fence'

# yielding: each block is taken its energy, which the run file and the result tell
sed 's/active = false/capacity_kj = 2000\nmax_deflection_m = 2/' site.toml >soft.toml
expect 0 talus-dda soft.toml --trn slope.tif --blocks blocks.h5 -o soft.h5 --no-db --json
cp out soft.json
prints '"n_crossings": 0'
expect 0 talus-dda soft.toml --trn slope.tif --blocks blocks.h5 -o again.h5 --no-db -q
cmp -s soft.h5 again.h5 || fail "two runs with a fence differ"

# too weak: panels break, when and by which block is said, and blocks continue
sed 's/active = false/capacity_kj = 20\nmax_deflection_m = 2/' site.toml >weak.toml
expect 0 talus-dda weak.toml --trn slope.tif --blocks blocks.h5 -o weak.h5 --no-db --json --set solver.duration_s=12
cp out weak.json
python3 - <<'PY' || fail 'fences of the result'
import json
rigid, soft, weak = (json.load(open(f + '.json')) for f in ('rigid', 'soft', 'weak'))
assert all(p['work_kj'] == 0 and p['deflection_m'] == 0 for p in rigid['fences'])
assert rigid['n_fence_hits'] >= 3 and soft['n_fence_hits'] >= 3
work = [p['work_kj'] for p in soft['fences']]
assert 50 < sum(work) < 2000 and max(p['deflection_m'] for p in soft['fences']) < 0.01
broken = [p for p in weak['fences'] if p['broken']]
assert len(broken) >= 3 and all(abs(p['work_kj'] - 20) < 1e-4 for p in broken), weak['fences']
assert all(p['work_kj'] < 20 for p in weak['fences'] if not p['broken'])
assert {p['broken_by_block'] for p in broken} == {0, 1, 2}
assert weak['n_crossings'] == 3
PY
expect 0 talus-dda weak.toml --trn slope.tif --blocks blocks.h5 -o said.h5 --no-db --set solver.duration_s=12
python3 - <<'PY' || fail 'the summary does not say which panels broke, when and by which block'
import json
broken = [p for p in json.load(open('weak.json'))['fences'] if p['broken']]
said = open('out').read()
for p in broken[:5]:
    words = f"{p['fence']} panel {p['panel']} at {p['broken_at_s']:.4g} s by block {p['broken_by_block']}"
    assert words in said, (words, said)
assert ('all with --json' in said) == (len(broken) > 5), said
PY

# fences that are refused
refused() {  # LINE TEXT
  sed "s|^line = .*|$1|; s/active = false/height_m = 4/" site.toml >bad.toml
  expect 1 talus-dda bad.toml --trn slope.tif --blocks blocks.h5 -o bad.h5 --no-db
  says "$2"
  nothing_left bad.h5
}
refused 'line = [[500060, 5000010], [500070, 5000010], [500070, 5000030], [500065, 5000005]]' \
  'fence.low: crosses itself at 500066, 5000010'
refused 'line = [[500060, 5000010, 990], [500060, 5000090, 970]]' 'fence.low: does not reach the ground'
refused 'line = [[500060, 5000010], [500160, 5000010]]' 'fence.low'
refused 'line = [[500060, 5000010], [500060, 5000090]]\nfile = "low.gpkg"' 'has both line and file'
refused 'line = [[500021, 5000030], [500021, 5000040]]' 'block 0 and panel 0 of fence low by'
# with law paper it stops nothing
expect 0 talus-dda rigid.toml --trn slope.tif --blocks blocks.h5 -o paper.h5 --no-db --set solver.law=paper --set solver.blocks=alone \
  --set solver.duration_s=0.001 --set solver.time_step_s=1e-4 --set solver.normal_stiffness_n_m=1e9
says 'fences stop nothing with law paper'
