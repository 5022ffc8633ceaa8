# A gallery in the terrain: a block dropped on its roof has the energy of its fall, others come to
# rest on it or pass over it, what lies under it is not hit; load cases, layer, no capacity.
. "$source_dir/tests/tools/talus-fence/dams.sh"
cat >site.toml <<'TOML'
[site]
name = "rocks"
crs = "EPSG:32632"
[ground.ground]
friction_deg = 25
cor = 0.3
[rockfall.a]
shape = "box"
size_m = [1, 0.8, 0.7]
position_m = [[500040, 5000035], [500040, 5000050], [500040, 5000065]]
height_above_ground_m = 1
velocity_m_s = [5, 0, 0]
rocks = 25
[dam.road]
kind = "gallery"
line = [[500096.2, 5000005], [500096.2, 5000095]]
height_m = 6
crest_width_m = 20
[object.road]
line = [[500098, 5000005], [500098, 5000095]]
width_m = 8
[object.yard]
polygon = [[500100, 5000020], [500120, 5000020], [500120, 5000080], [500100, 5000080]]
[solver]
duration_s = 16
TOML
# run NAME OPTIONS: terrain, rocks and a run, evaluated at gallery and objects
run() {
  compute "$@"
  shift
  expect 0 talus-trace site.toml "$@" $name/run_1.h5 --trn $name/bed.tif -o $name/trace.gpkg --json $name/trace.json --no-db
}
fence() { expect 0 talus-fence site.toml "$@" $name/run_1.h5 --trn $name/bed.tif -o $name/fence.gpkg --json $name/fence.json --no-db; }
run open --set dam.road.active=false
run roof
fence
prints 'gallery road: 75 blocks of 1 run: '
prints ' passed over it; its strength is not checked'
expect 0 talus-trace site.toml roof/run_1.h5 --compare open/run_1.h5 --trn roof/bed.tif -o both.gpkg --json both.json --no-db
expect 0 talus-trace site.toml roof/run_1.h5 --by-cells --trn roof/bed.tif -o cells.gpkg --json cells.json --no-db
run drop --set 'rockfall.a.position_m=[[500096, 5000050]]' --set rockfall.a.height_above_ground_m=10 \
  --set 'rockfall.a.velocity_m_s=[0, 0, 0]' --set rockfall.a.rocks=1 --set solver.duration_s=8
fence --set 'rockfall.a.position_m=[[500096, 5000050]]' --set rockfall.a.height_above_ground_m=10 \
  --set 'rockfall.a.velocity_m_s=[0, 0, 0]' --set rockfall.a.rocks=1 --set solver.duration_s=8
python3 - <<'PY' || fail "blocks on the roof and what lies under it"
import json, math
hits = lambda name: {o["name"]: o["hits_a_run"] for o in json.load(open(name))["objects"]}
before, now = hits("open/trace.json"), hits("roof/trace.json")
assert before["road"] > 30 and now["road"] == 0, (before, now)
assert hits("cells.json")["road"] == 0
road = next(o for o in json.load(open("both.json"))["objects"] if o["name"] == "road")
assert road["compared"]["hits_a_run"]["site"] == before["road"], road["compared"]

gallery, = json.load(open("roof/fence.json"))["dams"]
n = {k: v["n"] for k, v in gallery["verdicts"].items()}
assert sum(n.values()) == 75 and n["stopped"] > 30, n
assert gallery["kind"] == "gallery" and gallery["pass"] is None and gallery["capacity_kj"] is None
assert now["yard"] >= n["overtopped"], (now, n)  # beside the roof it is hit
cases = {c["name"]: c for c in gallery["load_cases"]}
assert list(cases) == ["p50", "p95", "p99", "max"] and "mass_kg" not in cases["p99"]
assert gallery["roof_hits"]["blocks"] <= gallery["roof_hits"]["hits"]
energies = [cases[k]["normal_energy_kj"] for k in ("p50", "p95", "max")]
assert 0 < energies[0] < energies[1] <= energies[2], energies
for case in (cases["p50"], cases["max"]):
    mass = 2600 * 1 * 0.8 * 0.7
    assert abs(case["mass_kg"] - mass) < 1e-6 * mass
    v = case["speed_m_s"] * math.sin(math.radians(case["angle_to_roof_deg"]))
    assert abs(0.5 * mass * v * v / 1e3 - case["normal_energy_kj"]) < 1e-9 * mass

# it falls 10 m, turned or not, and rests there
gallery, = json.load(open("drop/fence.json"))["dams"]
hardest = gallery["load_cases"][-1]
energy = 2600 * 0.56 * 9.80665 * 10 / 1e3
assert abs(hardest["normal_energy_kj"] / energy - 1) < 1e-6, (hardest, energy)
assert abs(hardest["angle_to_roof_deg"] - 90) < 1e-3 and gallery["roof_hits"]["blocks"] == 1
assert gallery["verdicts"]["overtopped"]["n"] == 0, gallery["verdicts"]
PY
# the valley edge lies between two nodes, where the terrain falls 8 m: heights count from the roof
z=$(awk 'BEGIN { printf "%.4f", 1000 - 96.2 * 0.5773502691896257 + 6 }')
ogrinfo -q -al roof/fence.gpkg dams | grep -q "LINESTRING ZM (500106.2 [0-9.]* $z" || fail "the edge does not lie at $z m"
ogrinfo -q -al roof/fence.gpkg dams | grep -q 'kind (String) = gallery' || fail 'no layer of galleries'
