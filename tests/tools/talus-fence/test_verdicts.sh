# 80 runs of one box, each a bit faster: at the line E = 171.1 kJ (1 + 0.01 r), capacity 250 kJ.
# 250 / 171.1 = 1.461: runs 0 to 46 are stopped, 47 to 79 pierce; all 80 arrive.
run-probe . 80
expect 0 talus-fence site.toml run_*.h5 --trn slope.tif -o fence.gpkg --json fence.json --csv fence.csv
prints '47 stopped, 33 pierced;'
[ "$(grep -c ,stopped, fence.csv)" = 47 ] || fail 'not 47 stopped'
[ "$(grep -c ,pierced, fence.csv)" = 33 ] || fail 'not 33 pierced'
python3 - <<'PY' || fail 'fence.json differs from the closed form'
import json, math
j = json.load(open('fence.json'))['fences'][0]
v = j['verdicts']
assert sum(x['n'] for x in v.values()) == 80
assert v['stopped']['share'] == 47 / 80 and v['stopped']['low'] < 47 / 80 < v['stopped']['high']
s = (30 - 11) / math.cos(math.pi / 6)
energies = [0.5 * 2600 * 2 * 3 * (1 + 0.01 * r) * s / 1e3 for r in range(80)]
e = j['whole']['energy_kj']
assert abs(e['max'] - energies[79]) < 1e-2 and abs(e['p50'] - energies[39]) < 1e-2
assert abs(e['p95'] - energies[75]) < 1e-2 and abs(e['p95_hi'] - energies[79]) < 1e-2, e  # 80 < 93: the largest
assert e['p99_hi'] is None
assert abs(j['whole']['mean_angle_to_normal_deg']) < 1e-9
assert abs(j['whole']['top_height_m']['max'] - 1.1) < 1e-6
assert j['fields'][0]['n'] == 80 and j['fields'][1]['n'] == 0
d = j['design']
assert len(d['sha256']) == 64 and 'gamma_energy_mel' in d['from_memory']
speed = math.sqrt(2 * 3 * 1.75 * s)
expected = 0.5 * 2600 * 1.1 * (1.21 * speed) ** 2 * 1.05 / 1e3
assert abs(d['whole']['design_energy_kj'] - expected) < 1e-3 * expected, (d, expected)
assert any('without the fence' in n for n in j['notes'])
PY
ogrinfo -so fence.gpkg fence_arrivals | grep -q 'Feature Count: 80' || fail 'not 80 arrivals'
ogrinfo -so fence.gpkg fence_posts | grep -q 'Feature Count: 3' || fail 'not 3 posts'
