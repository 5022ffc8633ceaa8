# A built fence: arrivals are first touches, with the energy before the touch, not after it.
mkdir stopped broken held pile rigid without many moving
run-probe stopped 80 standing=1 hits=stopped
expect 0 talus-fence stopped/site.toml stopped/run_*.h5 --trn stopped/slope.tif -o f.gpkg --json f.json --csv f.csv
prints '80 stopped; 80 first touches of the fence: largest energy'
[ "$(grep -c 'first touch' f.csv)" = 80 ] || fail 'not 80 rows of first touches'
run-probe broken 80 standing=1 hits=broken
expect 0 talus-fence broken/site.toml broken/run_*.h5 --trn broken/slope.tif -o g.gpkg --json g.json
prints '80 pierced; 80 first touches'
grep -q 'Panels broke in 80 of 80 runs: panel .* s by block ' g.json || fail 'nothing said of broken panels'
grep -q 'more (JSON: broken_panels)' g.json || fail 'the first broken panels are not said to be the first'
python3 -c "
import json
g, f = (json.load(open(n))['fences'][0]['broken_panels'] for n in ('g.json', 'f.json'))
assert f == [] and len({p['run_id'] for p in g}) == 80 and all(p['broken_at_s'] < 1 for p in g), g[:2]
" || fail 'broken panels'
python3 - <<'PY' || fail 'energies are not those before the first touch'
import json, math
s = (30 - 11) / math.cos(math.pi / 6)
for name in 'f.json', 'g.json':
    j = json.load(open(name))['fences'][0]
    e = j['whole']['energy_kj']
    assert j['arrivals'] == {'first_touches': 80, 'crossings': 0}
    assert abs(e['max'] - 0.5 * 2600 * 2 * 3 * 1.79 * s / 1e3) < 1e-2, e
    assert abs(e['p95'] - 0.5 * 2600 * 2 * 3 * 1.75 * s / 1e3) < 1e-2, e
    assert e['p99'] is None, 'p99 of 80 arrivals'
    assert j['design']['whole']['pass'] is False
PY

# A rigid fence, capacity unknown: high enough is not enough.
run-probe rigid 80 standing=1 hits=stopped capacity=none
expect 0 talus-fence rigid/site.toml rigid/run_*.h5 --trn rigid/slope.tif -o r.gpkg --json r.json
prints 'no capacity given: energy not checked'
grep -q '"pass": null' r.json || fail 'a fence without capacity is judged'
ogrinfo -q -al r.gpkg fence_fields | grep -q 'verdict (String) = energy not checked' || fail 'its field is judged'

# A block that hangs in a bulged panel is not behind the line; blocks that the pile holds are kept
# from passing.
run-probe held 3 standing=1 hits=held blocks=2
run-probe without 3 seed=1 blocks=2
expect 0 talus-fence held/site.toml held/run_*.h5 --without without/run_*.h5 --trn held/slope.tif -o h.gpkg --json h.json
prints '6 stopped'
run-probe pile 3 standing=1 hits=pile blocks=2 height=0.5
expect 0 talus-fence pile/site.toml pile/run_*.h5 --without without/run_*.h5 --trn pile/slope.tif -o p.gpkg --json p.json
python3 - <<'PY' || fail 'behind the line, kept volume or tags are wrong'
import json
h = json.load(open('h.json'))
c = h['fences'][0]['comparison']
assert c['with']['blocks_behind_the_line'] == 0 and c['without']['blocks_behind_the_line'] == 6
assert h['tags']['N_RUNS'] == '3' and 'all 6 blocks released in 3 runs' in h['tags']['DENOMINATOR']
assert h['tags']['N_RUNS_WITHOUT'] == '3'
p = json.load(open('p.json'))['fences'][0]
assert p['retained_m3'] == 0 and abs(p['kept_from_passing_m3'] - 1.3 * 2) < 1e-9
assert any('storage wedge' in n for n in p['notes']), p['notes']
PY

# In ten runs no block pierced: that bounds the share by the number of runs.
run-probe many 10 standing=1 hits=stopped blocks=2
expect 0 talus-fence many/site.toml many/run_*.h5 --trn many/slope.tif -o m.gpkg --json m.json --code onr
python3 - <<'PY' || fail 'an interval without width'
import json
f = json.load(open('m.json'))['fences'][0]
z = 1.959964 ** 2
assert f['verdicts']['pierced']['low'] == 0 and abs(f['verdicts']['pierced']['high'] - z / (10 + z)) < 1e-6
assert f['verdicts']['stopped']['high'] == 1 and abs(f['verdicts']['stopped']['low'] - 10 / (10 + z)) < 1e-6
assert f['free_border_m'] == f['design']['whole']['free_border_m'] == 0
assert any('2 fields' in n for n in f['notes'])
PY
expect 0 talus-fence many/site.toml many/run_*.h5 --trn many/slope.tif -o n.gpkg --json n.json --free-border-m 1.5
python3 - <<'PY' || fail '--free-border-m does not count'
import json
f = json.load(open('n.json'))['fences'][0]
w = f['design']['whole']
assert f['free_border_m'] == w['free_border_m'] == 1.5
assert abs(w['required_height_m'] - w['design_height_m'] - 1.5) < 1e-9
PY

# A block that still moves when the run ends may pass yet.
run-probe moving 1 standing=1 hits=stopped blocks=2 moving=1
expect 0 talus-fence moving/site.toml moving/run_0.h5 --without without/run_0.h5 --trn moving/slope.tif -o v.gpkg --json v.json
says '2 of the blocks that it stopped were still moving'
grep -q '"stopped_but_moving": 2' v.json || fail 'nothing says that they move'
! grep -q '"energy_at_the_line_kj_p50": [0-9]' v.json || fail 'a median of two blocks'
