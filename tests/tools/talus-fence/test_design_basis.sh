# Design values are those at the line that stops nothing; terminal, JSON and layer give one verdict.
mkdir touches open
run-probe touches 80 standing=1 hits=stopped capacity=1000
run-probe open 80 seed=1 capacity=1000
# the fence holds the blocks that touched it; that alone does not pass it
expect 0 talus-fence touches/site.toml touches/run_*.h5 --trn touches/slope.tif -o t.gpkg --json t.json
says 'first touches of the standing fence in 80 runs, which are not design values'
says 'make WITHOUT=yes; or talus-dda --set fence.check.active=false'
prints 'not judged: first touches of a standing fence are not design values'
# with the runs without it the line is judged by their crossings
expect 0 talus-fence touches/site.toml touches/run_*.h5 --without open/run_*.h5 --trn touches/slope.tif -o o.gpkg --json o.json
prints 'design by 80 crossings of its line in 80 runs without the fence, largest energy'
whole_lines out >o.out
# too few arrivals: not judged, with the demand of the largest of them
expect 0 talus-fence open/site.toml open/run_1.h5 open/run_2.h5 --trn open/slope.tif -o f.gpkg --json f.json
prints 'not judged: too few arrivals, 2 of the 59 that the code needs; by the largest of them it needs'
whole_lines out >f.out
# ten times the rock: no class is large enough
expect 0 talus-fence open/site.toml open/run_*.h5 --trn open/slope.tif -o n.gpkg --json n.json --design-block-m3 10
prints '(no ETAG class: above the largest, 4,500 kJ; a net is not an option)'
whole_lines out >n.out
ogrinfo -q -al o.gpkg fences >o.layer
ogrinfo -q -al f.gpkg fences >f.layer
ogrinfo -q -al n.gpkg fences >n.layer
python3 - <<'PY' || fail 'see above'
import json, math
def fence(name): return json.load(open(name))['fences'][0]
t, o, f, n = (fence(x) for x in ('t.json', 'o.json', 'f.json', 'n.json'))
assert t['design']['basis'] == 'first touches' and t['design']['whole']['verdict'] == 'first touches only'
assert t['design']['whole']['pass'] is None and t['at_open_line'] is None
assert o['design']['basis'] == 'line without the fence' and o['design']['whole']['verdict'] == 'meets'
assert o['design']['whole']['pass'] is True
assert f['design']['basis'] == 'line that stops nothing'
# one verdict in the same words
for name, j in ('o', o), ('f', f), ('n', n):
    words = j['design']['whole']['text']
    assert words in open(name + '.out').read(), words
    assert f'verdict_text (String) = {words}\n' in open(name + '.layer').read(), words
# the derivation: every box is the design block, 1 m3
d = {s['symbol']: s for s in o['design']['whole']['derivation']}
assert d['V']['value'] == 1 and d['V']['source'] == '95th percentile of the 80 blocks that arrive', d['V']
s = (30 - 11) / math.cos(math.pi / 6)
assert abs(d['v_p']['value'] - math.sqrt(2 * 3 * 1.75 * s)) < 1e-3, d['v_p']
assert abs(d['m_d']['value'] - 2.6 * 1.1) < 1e-9
assert abs(d['E_d']['value'] - 0.5 * d['m_d']['value'] * d['v_d']['value'] ** 2 * 1.05) < 1e-6
assert abs(d['E_req']['value'] - o['design']['whole']['required_capacity_kj']) < 1e-9
few = {s['symbol']: s for s in f['design']['whole']['derivation']}
assert few['V']['source'] == 'largest of the 2 blocks that arrive; the 95th percentile needs 59'
assert n['design']['whole']['derivation'][0]['source'] == 'given (--design-block-m3)'
PY
