# From ranges of a soil's numbers by runs of a Sobol design to the set that boulders do not contradict, and
# from its file to the next runs, which draw nothing else.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
command -v python3 >/dev/null || skip "needs python3"
# 40 x 60 cells of 4 m: 45 degrees in the north, from there on 14 degrees
awk 'BEGIN { print "ncols 40\nnrows 60\nxllcorner 650000\nyllcorner 5200000\ncellsize 4\nNODATA_value -9999"
  for (r = 0; r < 60; r++) { y = 4 * (59 - r); z = 500 + 0.25 * y + (y > 160 ? 0.75 * (y - 160) : 0)
    for (c = 0; c < 40; c++) printf "%g ", z; print "" } }' >dem.asc
mkdir slope
gdal_translate -q -ot Float64 -a_srs EPSG:25832 dem.asc slope/dem.tif
cat >slope/site.toml <<'END'
[site]
name = "slope"
[terrain]
dem = "dem.tif"
[rockfall.wall]
shape = "rock"
volume_m3 = 0.5
position_m = [[650080, 5200200], [650080, 5200210]]
height_above_ground_m = 1
rocks = 6
[ground.slope]
friction_deg = 35
cor = 0.5
[solver]
duration_s = 30
max_lost_share = 1
[output]
frames = false
[observed.may]
boulders_file = "boulders.csv"
[uncertainty.rolling]
keys = "ground.slope.rolling_resistance"
distribution = "uniform"
min = 0.05
max = 0.9
END
echo "include $source_dir/pipelines/site.mk" >slope/Makefile
printf 'x,y\n650078,5200160\n650082,5200155\n650080,5200150\n650079,5200158\n650081,5200152\n' >slope/boulders.csv
made slope -j2 RUNS=16 calibrate
python3 - <<'PY' || fail "the set"
import json, tomllib
said = json.load(open('slope/out/calibrate.json'))['calibration']
set_ = tomllib.load(open('slope/out/calibrate.toml', 'rb'))['uncertainty']['calibrated']
drawn = sorted(run['drawn'][0] for run in said['runs'])
kept = sorted(run['drawn'][0] for run in said['runs'] if run['implausibility'] <= 3)
assert len(drawn) == 16 and all(0.05 + 0.85 * k / 16 <= x <= 0.05 + 0.85 * (k + 1) / 16 for k, x in enumerate(drawn)), drawn
assert 0 < len(kept) < 16 and set_['values'] == kept and said['n_plausible'] == len(kept), kept
assert set_['keys'] == ['ground.slope.rolling_resistance'] and set_['distribution'] == 'rows'
assert said['left_out']['n'] == 5 and said['left_out_layers'] == []
PY

# a file of the results cannot be an input: the next make would change it
cp slope/site.toml kept.toml
printf '[uncertainty]\nfile = "out/calibrate.toml"\n' >>slope/site.toml
expect 2 make -C slope BIN= runs
says 'is an input and lies in out, the folder of the results'
cp kept.toml slope/site.toml
cp slope/out/calibrate.toml slope/
printf '[uncertainty]\nfile = "calibrate.toml"\n' >>slope/site.toml
made slope -j2 RUNS=4 OUT=next calibrate
python3 - <<'PY' || fail "the next runs draw something else"
import json, tomllib
kept = tomllib.load(open('slope/calibrate.toml', 'rb'))['uncertainty']['calibrated']['values']
runs = json.load(open('slope/next/calibrate.json'))['calibration']['runs']
assert len(runs) == 4 and all(run['drawn'][0] in kept for run in runs), (runs, kept)
PY
