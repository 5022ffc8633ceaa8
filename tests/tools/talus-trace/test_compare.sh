# Two sets of runs of the same seeds: hits and energies of both, and differences over pairs of runs.
mkdir site variant
run-probe site 20 blocks=3 objects=watched seeds=1
run-probe variant 20 blocks=3 objects=watched still_runs=8 seed=1 seeds=1
expect 0 talus-trace site/site.toml variant/run_*.h5 --compare site/run_*.h5 --trn site/slope.tif -o trace.gpkg --json trace.json
expect 0 talus-trace site/site.toml variant/run_*.h5 --trn site/slope.tif -o alone.gpkg --json alone.json
expect 0 talus-trace site/site.toml site/run_*.h5 --trn site/slope.tif -o site.gpkg --json site.json
cat >check.py <<'PY'
import json, math
t, alone, site = (json.load(open(name + '.json'))['objects'] for name in ('trace', 'alone', 'site'))
for o, a, s in zip(t, alone, site):
    compared = o.pop('compared')
    assert o == a, 'the comparison changed the rest'
    hits = compared['hits_a_run']
    assert compared['n_runs'] == compared['n_pairs'] == 20
    assert abs(hits['site'] - s['hits_a_run']) < 1e-12 and abs(hits['variant'] - a['hits_a_run']) < 1e-12, hits
    if o['name'] == 'shed':
        assert hits['difference'] == 0 and hits['interval'] == [None, None], hits
        continue
    # 8 of 20 pairs differ by one hit: Student's quantile of 7 degrees of freedom
    assert abs(hits['difference'] + 0.4) < 1e-12, hits
    half = 2.364624 * math.sqrt(0.4 * 0.6 * 20 / 19 / 20)
    assert abs(hits['interval'][0] + 0.4 + half) < 1e-6 and abs(hits['interval'][1] + 0.4 - half) < 1e-6, hits
    energy = compared['energy_a_run_kj']
    assert energy['difference'] < 0 and energy['interval'][1] < 0, energy
PY
python3 check.py || fail 'the differences are other ones'
expect 0 talus-reduce site/run_*.h5 --trn site/slope.tif -o part.h5
expect 0 talus-trace site/site.toml variant/run_*.h5 --compare part.h5 --trn site/slope.tif -o part.gpkg --json part.json
python3 - <<'PY' || fail 'a part gives other differences'
import json
a, b = (json.load(open(name))['objects'] for name in ('trace.json', 'part.json'))
assert a == b
PY
# with a frequency and people there: differences of rates and of risks are those of the two sites
exposed='presence = 0.5\nvulnerability = [0.6]\npersons_per_day = 3\n'
sed "s/^\(kind\|radius_m\) .*/&\n$exposed/; s/^polygon = .*250062.*/&\n$exposed/" site/site.toml >people.toml
printf '[hazard]\nrecipe = "new_zealand_christchurch"\n[hazard.class.V1]\nfrequency_per_a = 0.02\n' >>people.toml
expect 0 talus-trace people.toml variant/run_*.h5 --compare site/run_*.h5 --trn site/slope.tif -o people.gpkg --json people.json
expect 0 talus-trace people.toml site/run_*.h5 --trn site/slope.tif -o site_people.gpkg --json site_people.json
python3 - <<'PY' || fail 'differences of rates or risks are not those of the two sites'
import json, math
variant, site = (json.load(open(name + '.json'))['objects'] for name in ('people', 'site_people'))
for v, s in zip(variant, site):
    rate, risk = v['compared']['frequency_per_a'], v['compared']['risk_per_a']
    for d, of in (rate, lambda o: o['frequency_per_a'][0]), (risk, lambda o: o['risk']['individual_per_a'][0]):
        assert abs(d['site'] - of(s)) < 1e-12 and abs(d['variant'] - of(v)) < 1e-12, (d, of(s), of(v))
        assert abs(d['difference'] - (of(v) - of(s))) < 1e-12, (d, of(s), of(v))
assert variant[0]['compared']['risk_per_a']['interval'][1] < 0
PY

# A measure that changes how often, or who is there: the other side is the site without --variant.
# By hand: all 20 runs hit, 0.02 a year before and 0.002 with the slope scaled; deaths of the one
# most at risk 0.5 x 0.6 x 0.02 before and 0.05 x 0.6 x 0.02 with the house closed.
cat people.toml - >measures.toml <<'TOML'
[variant.scaled]
hazard.class.V1.frequency_per_a = 0.002
[variant.closed]
object.house.presence = 0.05
TOML
for name in scaled closed; do
  expect 0 talus-trace measures.toml --variant $name site/run_*.h5 --compare site/run_*.h5 --trn site/slope.tif -o $name.gpkg --json $name.json
done
python3 - <<'PY' || fail 'the site is compared as if it were the measure'
import json, math
def house(name): return next(o for o in json.load(open(name + '.json'))['objects'] if o['name'] == 'house')
scaled, closed = house('scaled'), house('closed')
for of in scaled, closed: assert of['compared']['hits_a_run']['difference'] == 0
rate = scaled['compared']['frequency_per_a']
assert abs(rate['site'] - 0.02) < 1e-12 and abs(rate['difference'] + 0.018) < 1e-12, rate
assert abs(scaled['frequency_per_a'][0] - 0.002) < 1e-12
risk, rate = closed['compared']['risk_per_a'], closed['compared']['frequency_per_a']
assert rate['difference'] == 0, rate
before, now = 1 - math.exp(-0.006), 1 - math.exp(-0.0006)
assert abs(risk['site'] - before) < 1e-12 and abs(risk['variant'] - now) < 1e-12, risk
assert abs(risk['difference'] - (now - before)) < 1e-12, risk
run_ids = {json.load(open(name + '.json'))['run_id'] for name in ('trace', 'alone')}
assert len(run_ids) == 2, 'another comparison has the same run_id'
PY

# Rocks with frequencies of their own, 0.02 a year each: one of three passes the house in 20 runs,
# or in 12 of 20, so 0.06 x 20 / 60 = 0.02 and 0.012 a year.
mkdir rocks fewer
run-probe rocks 20 blocks=3 objects=watched seeds=1 weight=0.02 independent=1
run-probe fewer 20 blocks=3 objects=watched still_runs=8 seed=1 seeds=1 weight=0.02 independent=1
printf '[hazard.class.all]\n[rockfall.cliff]\nfrequency_per_a = 0.06\n' | cat rocks/site.toml - >rocks.toml
expect 0 talus-trace rocks.toml fewer/run_*.h5 --compare rocks/run_*.h5 --trn rocks/slope.tif -o rocks.gpkg --json rocks.json
python3 - <<'PY' || fail 'frequencies of rocks that have their own are not compared'
import json
o = json.load(open('rocks.json'))['objects'][0]
rate = o['compared']['frequency_per_a']
assert abs(rate['site'] - 0.02) < 1e-12 and abs(rate['variant'] - 0.012) < 1e-12, rate
assert abs(rate['difference'] + 0.008) < 1e-12 and abs(o['frequency_per_a'][0] - 0.012) < 1e-12, rate
PY

mkdir other
run-probe other 3 blocks=3 objects=watched seed=2 seeds=100
expect 1 talus-trace site/site.toml variant/run_*.h5 --compare other/run_*.h5 --trn site/slope.tif -o x.gpkg
says 'has no run of the same seed as'
nothing_left x.gpkg
