# A mass on a plane of 25 degrees whose friction is 30: its factor is tan(30) / tan(25), and what
# water, an earthquake and drawn friction make of it.
. "$source_dir/tests/tools/talus-dda/common.sh"
command -v python3 >/dev/null || skip "needs python3"
make_terrain
cat >site.toml <<'TOML'
[source]
# off the nodes, so that the ramps at the sides of the bed do not hold the corners of blocks
polygon = [[500041, 5000031], [500069, 5000031], [500069, 5000058], [500041, 5000058]]
failure_surface = "plane"
plane_dip_deg = 25
plane_dip_direction_deg = 90
plane_point_m = [500070, 5000045, 959.585]
min_block_volume_m3 = 5
[joints.rear]
dip_deg = 90
dip_direction_deg = 90
spacing_m = 9
[joints.lateral]
dip_deg = 90
dip_direction_deg = 0
spacing_m = 9
[material.rock]
friction_deg = 30
[ground.rock]
friction_deg = 30
cor = 0
[solver]
n_runs = 12
TOML
expect 0 talus-blocks site.toml --trn slope.tif -o blocks.h5 --trn-out bed.tif -q --no-db
stability() { talus-stability site.toml --trn bed.tif --blocks blocks.h5 -q --no-db --overwrite "$@"; }

# holds EXPRESSION of r, the levels of FOLDER/stability.json
holds() { python3 -c "
import json, math, sys
j = json.load(open('$1/stability.json')); r = j['levels']
tan = lambda d: math.tan(math.radians(d))
assert $2, j" || fail "$1: $2"; }

expect 0 stability -o dry
holds dry "len(r) == 1 and abs(r[0]['mass']['factor'] / (tan(30) / tan(25)) - 1) < 0.01"
holds dry "r[0]['mass']['moves'] - r[0]['mass']['holds'] <= 0.01 and r[0]['first']['moves'] <= r[0]['mass']['moves']"
holds dry "len(j['factor_of_block']) > 6 and min(j['factor_of_block']) == r[0]['first']['moves']"
[ "$(ogrinfo -so dry/blocks.gpkg blocks | grep -c 'factor: Real')" -eq 1 ] || fail "no factor of the blocks"
nothing_left dry/levels.svg

# W (cos - k sin) tan(phi) / (W (sin + k cos))
expect 0 stability -o shaken --seismic 0.1
holds shaken "abs(r[0]['mass']['factor'] / ((1 - 0.1 * tan(25)) * tan(30) / (tan(25) + 0.1)) - 1) < 0.01"

# uplift of (depth of the plane - depth of the water), and more where that rises
cat >>site.toml <<'TOML'
[water]
depth_m = 1.5
drained = ["rear", "lateral", "source_side"]
TOML
expect 0 stability -o wet --levels=-10,1
holds wet "[row['water_higher_m'] for row in r] == [0, -10, 1]"
holds wet "r[2]['mass']['factor'] < r[0]['mass']['factor'] - 0.03 < r[1]['mass']['factor'] - 0.06"
holds wet "abs(r[1]['mass']['factor'] / (tan(30) / tan(25)) - 1) < 0.01"
[ -s wet/levels.svg ] || fail "no chart of the levels"

# The failed samples are those whose friction is below 25 degrees: about half of 23 to 27
sed '/^\[water\]/,$d' site.toml >drawn.toml
cat >>drawn.toml <<'TOML'
[uncertainty.friction]
keys = ["ground.rock.friction_deg", "material.rock.friction_deg"]
distribution = "uniform"
min = 23
max = 27
TOML
expect 0 talus-stability drawn.toml --trn bed.tif --blocks blocks.h5 --no-db -o drawn
holds drawn "j['drawn']['samples'] == 12 and 4 <= j['drawn']['failed'] <= 8"
holds drawn "j['drawn']['low'] < j['drawn']['probability'] < j['drawn']['high']"
prints "probability of failure with the drawn values"

expect 1 talus-stability drawn.toml --trn bed.tif --blocks blocks.h5 --no-db -o none --levels=1
says "--levels moves the water of [water], and there is none"
expect 1 stability -o none --levels=high
says "expected metres and commas"
expect 1 stability -o none --set solver.blocks=alone
says "each block moves alone"
