# A dam in the terrain: arrivals, passages over its crest, and whether it holds, for a
# high one, a low one and one that is for less energy; lines, layers, report, look before the runs.
. "$source_dir/tests/tools/talus-fence/dams.sh"
cat >site.toml <<'TOML'
[site]
name = "rocks"
crs = "EPSG:32632"
[ground.ground]
friction_deg = 18
cor = 0.4
[rockfall.a]
shape = "box"
size_m = [1, 0.8, 0.7]
position_m = [[500010, 5000035], [500010, 5000050], [500010, 5000065]]
height_above_ground_m = 1
velocity_m_s = [6, 0, 0]
rocks = 30
[dam.road]
line = [[500115, 5000010], [500115, 5000090]]
height_m = 12
slopes_deg = [75, 45]
capacity_kj = 2000
[dam.below]
active = false
line = [[500131, 5000010], [500131, 5000090]]
height_m = 5
slopes_deg = [75, 45]
[solver]
duration_s = 14
[output]
passages = false
TOML
# run NAME OPTIONS: the dam's terrain, rocks and a run, evaluated
run() {
  compute "$@"
  shift
  expect 0 talus-fence site.toml "$@" $name/run_1.h5 --trn $name/bed.tif -o $name/fence.gpkg --json $name/fence.json --csv $name/fence.csv --no-db
}
run high
prints 'dam road: 90 blocks of 1 run: '
prints 'holds: none passed over the crest; energy '
run low --set dam.road.height_m=0.8 --set dam.road.crest_width_m=1
prints ' blocks passed over the crest'
run weak --set dam.road.capacity_kj=1
prints 'does not hold: the energy is '
run alone --set rockfall.a.rocks=2
prints 'not judged: too few arrivals, '
run short --set solver.duration_s=9
prints 'not judged: blocks that had not passed it still moved at the end: '
# 16 m from the crest, where uphill is looked for, the ground is 0.6 m high and the next dam 5 m
run single --set dam.road.height_m=5
run pair --set dam.road.height_m=5 --set dam.below.active=true
expect 1 talus-fence site.toml --set dam.below.active=true high/run_1.h5 --trn high/bed.tif -o no.gpkg --no-db
says 'dam.below: is active, and the terrain was made without it'
for other in height_m=2 ditch_m=[1,3] 'line=[[500115,5000011],[500115,5000090]]'; do
  expect 1 talus-fence site.toml --set "dam.road.$other" high/run_1.h5 --trn high/bed.tif -o no.gpkg --no-db
  says 'dam.road: is active, and the terrain was made without it or with another shape of it'
done
expect 1 talus-fence site.toml --set dam.road.active=false high/run_1.h5 --trn high/bed.tif -o no.gpkg --no-db
says 'dam.road: is in the ground of the terrain, and not active here'
python3 - <<'PY' || fail "what comes and what passes"
import csv, json
of = {name: json.load(open(name + "/fence.json"))["dams"][0] for name in ("high", "low", "weak")}
high, low = of["high"], of["low"]
n = {k: v["n"] for k, v in high["verdicts"].items()}
assert sum(n.values()) == 90 and n["overtopped"] == 0 and n["stopped"] > 60, n
short = json.load(open("short/fence.json"))["dams"][0]
assert short["still_moving"] > 0 and short["pass"] is None and short["verdict"] == "still moving", short
assert high["still_moving"] == 0 and high["pass"] is True and low["pass"] is False and of["weak"]["pass"] is False
assert low["verdicts"]["overtopped"]["n"] == low["passing"]["n"] > 10, low["verdicts"]
single, pair = (json.load(open(name + "/fence.json"))["dams"][0] for name in ("single", "pair"))
assert pair["arriving"]["n"] == single["arriving"]["n"] > 60, (pair["arriving"], single["arriving"])
# the arrivals are the same: the dam begins behind that line
for key in "n", "mean_angle_to_normal_deg":
    assert abs(high["arriving"][key] - of["weak"]["arriving"][key]) < 1e-9
# a rock of 1.5 t that fell 57 m at most, with friction
assert 5 < high["arriving"]["energy_kj"]["p95"] < 800, high["arriving"]
rows = [row for row in csv.DictReader(open("low/fence.csv"))]
assert len(rows) == 90 and {r["fence"] for r in rows} == {"dam.road.before"}
PY
ogrinfo -q -al high/fence.gpkg dams | grep -q 'verdict (String) = meets' || fail 'no layer of dams'

# before the runs: the look has the crest, as a line that fall lines come to
expect 0 talus-check site.toml --trn high/trn.tif --bed high/bed.tif --blocks high/blocks.h5 -o check.html --reports high/trn.json --probe-s 0 --no-db
prints 'dam.road: 80 m long'
grep -q 'dam.road' check.html || fail 'no dam on the page'
