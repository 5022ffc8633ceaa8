# Runs draw by [uncertainty]: the same values for any caller, in any order, with more runs or with
# fewer. Rock masses are cut anew, and runs on different beds are evaluated together. Places say how
# many runs are lacking, and RUNS=auto makes them.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v python3 >/dev/null || skip "needs python3"

uncertain() {
  site "$1"
  sed -i 's/^duration_s = .*/duration_s = 2/' "$1/site.toml"  # some of it moves
  cat >>"$1/site.toml" <<'END'
[uncertainty]
rock_masses = 2
terrain_rmse_m = 0.2
terrain_correlation_m = 40
[uncertainty.friction]
keys = ["ground.slope.friction_deg", "material.rock.friction_deg"]
apply = "add"
distribution = "normal"
std = 2
source = "a guess"
[uncertainty.spacing]
keys = "joints.rear.spacing_m"
distribution = "uniform"
min = 7
max = 9
[place.foot]
polygon = [[500100, 5200200], [500140, 5200200], [500140, 5200250], [500100, 5200250]]
half_width = 0.5
[place.valley]
fence = "valley"
half_width = 0.5
END
}
uncertain slope
made slope -j2 WITHOUT=no RUNS=2 runs
expect 0 talus-site slope/site.toml -o printed --no-db
prints "friction: ground.slope.friction_deg, material.rock.friction_deg: what is added is drawn from normal"
prints "2 rock masses, each cut anew"
stat -c %Y slope/out/runs/run_1.h5 >before
made slope WITHOUT=no RUNS=4
grep -q 'not drawn' slope/out/check.json && fail 'the look before the runs says that they draw nothing'
[ "$(stat -c %Y slope/out/runs/run_1.h5)" = "$(cat before)" ] || fail "a run was made again for more runs"
# in reverse order, in another folder, by hand
uncertain other
made other WITHOUT=no RUNS=1 SEED=4 runs
made other -j2 WITHOUT=no RUNS=4
same slope other

python3 - <<'PY' || fail "the run table does not show what was drawn"
import csv, json
rows = {int(r['seed']): r for r in csv.DictReader(open('slope/out/runs.csv'))}
assert sorted(rows) == [1, 2, 3, 4], list(rows)
for seed, r in rows.items():
    assert int(float(r['sample'])) == seed and int(float(r['rock_mass'])) == (seed - 1) % 2 + 1, r
    ground, rock = float(r['ground.slope.friction_deg']), float(r['material.rock.friction_deg'])
    assert abs(ground - rock) < 1e-6 and abs(ground - 25) < 8, r    # 25 and 25, moved together
    assert abs(float(r['friction_deg.slope']) - ground) < 1e-5, r   # as the run computed
frictions = {r['ground.slope.friction_deg'] for r in rows.values()}
spacings = [float(rows[s]['joints.rear.spacing_m']) for s in (1, 2, 3, 4)]
assert len(frictions) == 4, frictions
assert spacings[0] == spacings[2] != spacings[1] == spacings[3], spacings
assert all(7 < s < 9 for s in spacings), spacings
report = json.load(open('slope/out/runout.json'))
assert report['sensitivity'] and all(row['first_order'] is None for row in report['sensitivity'])
page = open('slope/out/report.html').read()
for words in ('What differs from run to run', 'a guess', 'not enough runs', 'rock_mass', '2 rock masses'):
    assert words in page, words
places = json.load(open('slope/out/places.json'))
assert [p['place'] for p in places['places']] == ['foot', 'valley'], places
assert places['places'][0]['half_width'] is None, places    # two masses give no interval
PY

# blocks and beds of the two masses differ, and neither is that of the site file
cmp -s slope/out/rock/blocks_1.h5 slope/out/rock/blocks_2.h5 && fail "two rock masses are alike"
cmp -s slope/out/rock/bed_1.tif slope/out/bed.tif && fail "the ground of a mass is that of the map"
expect 1 talus-maps slope/out/runs --trn slope/out/rock/bed_1.tif -o maps --no-db
says "runs of several rock masses are evaluated on the terrain that they were cut from"

# without a sample nothing is drawn, and it is said
expect 0 talus-dda slope/site.toml --trn slope/out/bed.tif --blocks slope/out/blocks.h5 -o plain.h5 --no-db --set solver.duration_s=0.05
says "2 quantities of [uncertainty] not drawn"
expect 1 talus-dda slope/site.toml --trn slope/out/bed.tif --blocks slope/out/blocks.h5 -o other.h5 --no-db \
  --sample 3 --set uncertainty.friction.std=60
says "of what it draws lies outside of"
expect 2 make -C slope BIN= SEED=0 runs
says "samples of [uncertainty] count from 1"

# as many runs as the places want, and no more than are allowed
expect 2 make -C slope BIN= -j2 WITHOUT=no RUNS=auto RUNS_MOST=4 places
says "raise rock_masses to 10 or more"
site auto
cat >>auto/site.toml <<'END'
[uncertainty.friction]
keys = "ground.slope.friction_deg"
distribution = "normal"
std = 2
[place.valley]
fence = "valley"
half_width = 0.2
END
made auto -j2 WITHOUT=no RUNS=auto RUNS_MOST=12 maps
says "--runs auto: 12 runs are enough"
sed -i 's/^half_width = .*/half_width = 0.01/' auto/site.toml
made auto -j2 WITHOUT=no RUNS=auto RUNS_MOST=12 places
says "--runs auto: 12 runs are not enough"
made slope clean
[ ! -d slope/out ] || fail "clean left $(find slope/out)"
