# Cases stand side by side, what each run drew is in the run table, and a fence without capacity is
# called a wall below its numbers.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v python3 >/dev/null || skip "needs python3"
site slope
sed -i -e 's/^duration_s = .*/duration_s = 3\nfriction_scatter_deg = 2/' slope/site.toml
held='--set ground.slope.friction_deg=70 --set material.rock.friction_deg=70'
far='--set ground.slope.friction_deg=15'
set -- RUNS=2 WITHOUT=no CASES='far near' CASE_far="$far" CASE_near="$held"
made slope -j2 "$@" runout
prints "2 of 4 runs did not move"
prints "case far: 2 of 2 runs moved"
prints "case near: 0 of 2 runs moved, 0 % of the mass"
prints "what stands for all runs together counts each run of each case alike"
made slope "$@" report
python3 - <<'PY' || fail "cases are not side by side"
import csv, json
cases = {c['case']: c for c in json.load(open('slope/out/runout.json'))['cases']}
assert list(cases) == ['far', 'near'], list(cases)
assert cases['far']['n_runs_moved'] == 2 and cases['near']['n_runs_moved'] == 0, cases
assert cases['far']['moved']['share_moved_1_m'] > .5 and cases['near']['moved']['share_moved_1_m'] == 0
rows = list(csv.DictReader(open('slope/out/runs.csv')))
assert sorted(r['case'] for r in rows) == ['far', 'far', 'near', 'near']
for case, mean in ('far', 15), ('near', 70):
    drawn = [float(r['friction_deg.slope']) for r in rows if r['case'] == case]
    assert drawn[0] != drawn[1] and all(0 < abs(d - mean) < 8 for d in drawn), drawn
page = open('slope/out/report.html').read()
assert '2 of 2' in page and '0 of 2' in page and 'mass that moved more than 1 m' in page
assert page.count('the fence is a rigid wall') >= 2, page.count('the fence is a rigid wall')
PY
