# Design volumes of a list of blocks: edges with mean 0.5 m, 1 m3 every 10 years (closed form).
awk 'BEGIN { print "edge_m"; for (i = 0; i < 400; ++i) printf "%.9g\n", -0.5 * log(1 - (i + 0.5) / 400) }' >list.csv
expect 0 talus-blocks --sizes list.csv --anchor-volume-m3 1 --anchor-years 10 --scenarios classes.toml --json
python3 - <<'PY' || fail 'design volumes'
import json
r = json.load(open('out'))
assert r['n_blocks'] == 400 and r['law'] == 'exponential', r['law']
for design, volume in zip(r['design'], (3.719, 9.956, 19.696)):
    assert abs(design['volume_m3'] - volume) < 0.02 * volume, design
    assert design['low_m3'] < volume < design['high_m3'], design
PY
grep -q '^\[hazard.class.V100\]$' classes.toml && grep -q '^frequency_per_a = 0.00333333$' classes.toml || fail 'scenarios'
expect 2 talus-blocks --sizes list.csv
says 'give --anchor-volume-m3 and --anchor-years'
expect 2 talus-blocks
says 'is not given'
printf 'volume_m3\n1\n2\n-3\n' >bad.csv
expect 1 talus-blocks --sizes bad.csv --anchor-volume-m3 1 --anchor-years 10
says 'bad.csv:4: has a size that is not above 0'
printf 'volume_m3\n1\n2\n' >few.csv
expect 1 talus-blocks --sizes few.csv --anchor-volume-m3 1 --anchor-years 10
says 'holds 2 blocks'
printf 'size\n1\n' >none.csv
expect 1 talus-blocks --sizes none.csv --anchor-volume-m3 1 --anchor-years 10
says 'neither a column volume_m3 nor one edge_m'
