# Rocks that fall one by one meet each the fence and the trees as they were at the start: how many
# are released in one run changes no share, and a rock never finds a net that another one loaded.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
site() {  # SEED N_PER_POINT: rocks that come to a wood, and to a line behind it
  cat <<END
[site]
name = "rocks"
[material.rock]
density_kg_m3 = 2600
[ground.ground]
friction_deg = 25
cor = 0.4
[rockfall.a]
shape = "box"
size_m = [1, 0.8, 0.7]
position_m = [[500010, 5000035], [500010, 5000050], [500010, 5000065]]
height_above_ground_m = 1
velocity_m_s = [6, 0, 0]
rocks = $2
seed = $1
[solver]
duration_s = 14
max_lost_share = 1
[output]
passages = false
END
}
wood='[forest.wood]
polygon = [[500040, 5000020], [500090, 5000020], [500090, 5000080], [500040, 5000080]]
stems_per_ha = 700
dbh_mean_cm = 20
[fence.road]
line = [[500095, 5000001], [500095, 5000099]]
active = false'
fall() {  # NAME RUN OPTIONS
  name=$1 run=$2
  shift 2
  talus-dda $name.toml --trn slope.tif --blocks ${name}_blocks.h5 -o $run --no-db "$@"
}
blocks() { talus-blocks $1.toml --trn slope.tif -o $1_blocks.h5 -q --no-db 2>blocks.log; }

# 2, 10 and 40 rocks a point: the same share of them comes to the road
for n in 2 10 40; do
  for seed in $(seq $((40 / n))); do
    name=wood_${n}_$seed
    { site "$seed$n" $n && echo "$wood"; } >$name.toml
    blocks $name
    expect 0 fall $name $name.h5 --json
    cp out $name.json
  done
done
cat >shares.py <<'PY'
import glob, json
def wilson(k, n, z=2.58):  # 99 %
    p, d = k / n, 1 + z * z / n
    half = z * ((p * (1 - p) + z * z / (4 * n)) / n) ** 0.5
    return (p + z * z / (2 * n) - half) / d, (p + z * z / (2 * n) + half) / d
share = {}
for n in (2, 10, 40):
    runs = [json.load(open(f)) for f in glob.glob(f'wood_{n}_*.json')]
    through, rocks = (sum(r[key] for r in runs) for key in ('n_crossings', 'n_blocks'))
    assert rocks == 120 and all(r['trees']['n_stems'] > 150 for r in runs)
    low, high = wilson(through, rocks)
    share[n] = (low, through / rocks, high)
    print(n, share[n], [r['trees']['n_stems_hit'] for r in runs])
for a in share:
    assert 0.1 < share[a][1] < 0.9, share
    for b in share:
        assert share[a][0] <= share[b][1] <= share[a][2], share
PY
python3 shares.py || fail 'the share of rocks that come through depends on how many fall in a run'

# a net whose hits are all below its capacity loses no panel, and lets nobody through
net() {  # NAME CAPACITY_KJ [WOOD]
  { site 5 30 | sed 's/^size_m = .*/size_m = [2, 1.5, 1]/'
    printf '[fence.net]\nline = [[500095, 5000001], [500095, 5000099]]\nheight_m = 8\n'
    printf 'capacity_kj = %s\nmax_deflection_m = 2\n' $2
    [ $# -lt 3 ] || echo "$wood" | sed -n '1,4p'; } >$1.toml
  blocks $1
}
net net 3000
expect 0 fall net net.h5 --json
cp out net.json
python3 - <<'PY' || fail 'a net whose hits are all below its capacity'
import json
run = json.load(open('net.json'))
rows = [p for p in run['fences'] if 'rock' in p]
at_start = [p for p in run['fences'] if 'rock' not in p]
assert all(p['work_kj'] == 0 and not p['broken'] for p in at_start) and len(at_start) > 5
assert len({p['rock'] for p in rows}) > 40 and 'broken_at_s' not in str(rows)
assert sum(p['work_kj'] for p in rows) > 3 * 3000 and max(p['work_kj'] for p in rows) < 3000
PY
expect 0 fall net said.h5
prints 'on fences, panels broken by 0 of 90 rocks'
expect 0 talus-fence net.toml net.h5 --trn slope.tif -o fence.gpkg --json fence.json --no-db --overwrite
python3 - <<'PY' || fail 'verdicts of a net that holds'
import json
fence, = [f for f in json.load(open('fence.json'))['fences'] if f['name'] == 'net']
n = {name: v['n'] for name, v in fence['verdicts'].items()}
assert n['stopped'] > 40 and n['pierced'] == 0 and fence['broken_panels'] == [], n
assert fence['whole']['hits_in_that_second'] == 1 and fence['whole']['most_hits_in_a_run'] == 1
most = fence['whole']['energy_kj']['max']
assert abs(fence['whole']['energy_in_one_second_kj'] - most) < 1e-12 * most  # one hit, summed
assert any('fell one by one' in note for note in fence['notes']), fence['notes']
assert not any('dam those' in note or 'sum of their' in note for note in fence['notes'])
PY

# one that is too weak breaks rock by rock: the rock is named, and one that met a whole panel is
# stopped
net weak 600 wood
expect 0 fall weak weak.h5 --json
cp out weak.json
expect 0 talus-fence weak.toml weak.h5 --trn slope.tif -o fence.gpkg --json fence.json --no-db --overwrite
python3 - <<'PY' || fail 'a net that breaks for some rocks'
import json
run = json.load(open('weak.json'))
broken = [p for p in run['fences'] if p['broken']]
by = {p['rock'] for p in broken}
assert all(p['rock'] == p['broken_by_block'] and abs(p['work_kj'] - 600) < 0.1 for p in broken)
fence, = [f for f in json.load(open('fence.json'))['fences'] if f['name'] == 'net']
n = {name: v['n'] for name, v in fence['verdicts'].items()}
assert 5 < n['pierced'] <= len(by) < 90 and n['stopped'] > 5, (n, len(by))
assert {p['rock'] for p in fence['broken_panels']} == by
words = f"Panels broke for {len(by)} of 90 rocks, each of which met the whole fence"
assert any(words in note for note in fence['notes']), fence['notes']
PY

# stopped and resumed: the same bytes; from a part: the same counts
expect 0 fall weak whole.h5
prints 'that each rock met'
cmp weak.h5 whole.h5 || fail 'two runs differ'
stopped=
for pause in 1 0.5 2 4; do
  rm -f stopped.h5 stopped.h5.part
  talus-dda weak.toml --trn slope.tif --blocks weak_blocks.h5 -o stopped.h5 --no-db \
    -q --set output.checkpoint_interval_s=3600 &
  run_id=$!
  sleep $pause
  kill -TERM $run_id 2>/dev/null || true
  wait $run_id || true
  [ ! -s stopped.h5.part ] || { stopped=yes && break; }
done
[ -n "$stopped" ] || fail 'no run could be stopped'
expect 0 fall weak stopped.h5 -q --resume
cmp weak.h5 stopped.h5 || fail 'a resumed run differs'
expect 0 talus-reduce weak.h5 --trn slope.tif -o part.h5
for runs in weak part; do
  expect 0 talus-fence weak.toml $runs.h5 --trn slope.tif -o $runs.fence.gpkg --json $runs.fence.json --csv $runs.csv --no-db
  expect 0 talus-runout $runs.h5 --trn slope.tif -o $runs.gpkg --json $runs.runout.json --no-db
done
cmp weak.csv part.csv || fail 'verdicts of a part are others'
cmp weak.fence.json part.fence.json || fail 'fences of a part are others'
python3 - <<'PY' || fail 'trees, counted rock by rock'
import json
direct, part = (json.load(open(f + '.runout.json'))['trees'] for f in ('weak', 'part'))
assert direct == part
run = json.load(open('weak.json'))['trees']
forest, = direct['forests']
assert forest['n_rocks'] == 90 and forest['stems'] == run['n_stems']
assert abs(forest['hit'] - run['n_stems_hit'] / 90) < 1e-9
assert abs(forest['broken'] - run['n_stems_broken'] / 90) < 1e-9
assert 0 < forest['broken'] < forest['hit'] < 0.2 * forest['stems']
PY

# blocks that meet each other share the rest of a net
sed 's/^rocks = .*//; s/^\[rockfall/[blocks/; s/^capacity_kj = .*/capacity_kj = 1500/' weak.toml >meet.toml
blocks meet
expect 0 talus-dda meet.toml --trn slope.tif --blocks meet_blocks.h5 -o meet.h5 --no-db --json
cp out meet.json
grep -q '"rock"' meet.json && fail 'blocks that meet are told of one by one'
exit 0
