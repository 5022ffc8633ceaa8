# A mass on a plane of 25 degrees whose friction is 30: its factor is tan(30) / tan(25), and the
# effect of water, an earthquake and drawn friction on it.
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

# holds FOLDER EXPRESSION of FOLDER/stability.json: j, r its levels, g and first its groups
holds() { python3 -c "
import json, math, sys
j = json.load(open('$1/stability.json')); r = j['levels']; g, first = j['groups']
tan = lambda d: math.tan(math.radians(d))
assert $2, j" || fail "$1: $2"; }

expect 0 stability -o dry
holds dry "len(r) == 1 and abs(g['factor']['factor'] / (tan(30) / tan(25)) - 1) < 0.01"
holds dry "g['factor']['moves'] - g['factor']['holds'] <= 0.01 and first['factor']['moves'] <= g['factor']['moves']"
holds dry "len(j['factor_of_block']) > 6 and min(j['factor_of_block']) == first['factor']['moves']"
holds dry "g['n_blocks'] == len(j['factor_of_block']) and first['n_blocks'] == len(j['first_blocks'])"
holds dry "j['words'][0].startswith('The slope is held by a factor of 1.2')"
[ "$(ogrinfo -so dry/blocks.gpkg stability | grep -cE 'factor: Real|goes: String')" -eq 2 ] || fail "no factor of the blocks"
python3 "$source_dir/tests/tools/fields.py" "$source_dir/docs/reference/fields.md" dry/blocks.gpkg || fail "fields"
nothing_left dry/levels.svg

holds dry "abs(r[0]['as_one_body'] / (tan(30) / tan(25)) - 1) < 1e-3"

# W (cos - k sin) tan(phi) / (W (sin + k cos))
expect 0 stability -o shaken --seismic 0.1
holds shaken "abs(g['factor']['factor'] / ((1 - 0.1 * tan(25)) * tan(30) / (tan(25) + 0.1)) - 1) < 0.01"

# Uplift of (depth of the plane - depth of the water), and more where that rises; it fails where the
# uplift leaves W cos tan(phi) = W sin: at a head of (rho / rho_w) thickness cos^2 (1 - tan(25) / tan(30)).
cat >>site.toml <<'TOML'
[water]
depth_m = 1.5
drained = ["rear", "lateral", "source_side"]
TOML
expect 0 stability -o wet
holds wet "j['water'] == 'depth of the water below the surface [m]' and r[0]['is_dry'] and len(r) == 6"
holds wet "all(a['water_m'] > b['water_m'] and a['mass']['factor'] >= b['mass']['factor'] for a, b in zip(r, r[1:]))"
holds wet "abs(g['dry']['factor'] / (tan(30) / tan(25)) - 1) < 0.01"
holds wet "r[-1]['water_m'] == 0 and [row['water_m'] for row in r if row['is_given']] == [1.5]"
holds wet "[row['is_given'] for row in r].count(True) == 1 and g['factor']['factor'] < g['dry']['factor'] - 0.03"
holds wet "r[0]['water_m'] > g['fails_at_m'] > r[-1]['water_m']"
holds wet "'when dry; it fails when water in the joints rises to' in j['words'][0]"
holds wet "all(abs(row['mass']['factor'] / row['as_one_body'] - 1) < 0.01 for row in r if row['as_one_body'] > 0.3)"
holds wet "any(w.startswith('By limit equilibrium, as one body on its failure surface, it has a factor of') for w in j['words'])"
[ -s wet/levels.svg ] || fail "no chart of the levels"

# A tension crack behind it: thrust w h^2 / 2 L, h at most 3.2 m and L 27 m, is half of its
# resistance.
sed '/^\[water\]/,$d' site.toml >crack.toml
printf '[water]\ncracks = ["source_side"]\ncrack_fill_m = 1\n' >>crack.toml
expect 0 talus-stability crack.toml --trn bed.tif --blocks blocks.h5 --no-db -o crack
holds crack "j['water'] == 'water in the cracks above their foot [m]' and r[0]['water_m'] == 0"
holds crack "g['fails_at_m'] is None and 'it stands at every level of the water' in j['words'][0]"

# Barton and Bandis: the residual angle alone does not hold the mass; drawn, half of the samples do
sed '/^\[water\]/,$d' site.toml >rough.toml
sed -i '/^\[ground.rock\]/,$ s/^friction_deg = 30/friction_deg = 18\njrc = 5\njcs_mpa = 60/' rough.toml
cat >>rough.toml <<'TOML'
[uncertainty.roughness]
keys = ["ground.rock.jrc"]
distribution = "discrete"
values = [1, 4]
TOML
expect 0 talus-stability rough.toml --trn bed.tif --blocks blocks.h5 -q --no-db -o rough
holds rough "r[0]['as_one_body'] > 1.1 * tan(18) / tan(25)"
holds rough "abs(r[0]['mass']['factor'] / r[0]['as_one_body'] - 1) < 0.015"
holds rough "4 <= g['drawn']['failed'] <= 8"

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
holds drawn "g['drawn']['samples'] == 12 and 4 <= g['drawn']['failed'] <= 8"
holds drawn "first['drawn']['failed'] >= g['drawn']['failed']"
holds drawn "g['drawn']['low'] < g['drawn']['probability'] < g['drawn']['high']"
prints "With the drawn strengths it fails in"

# A pulse of base motion: the mass slips and holds as before, since friction is not used up.
sed '/^\[water\]/,$d' site.toml >quake.toml
cat >>quake.toml <<'TOML'
[base_motion]
amplitude_m_s2 = 4
frequency_hz = 2
duration_s = 1
direction_deg = 90
TOML
expect 0 talus-stability quake.toml --trn bed.tif --blocks blocks.h5 --no-db -o quake
holds quake "abs(g['shaken']['factor'] / (tan(30) / tan(25)) - 1) < 0.02"
prints "After the given earthquake it is held by a factor of 1.2"
prints "The earthquake displaces it by"

expect 1 stability -o none --set solver.blocks=alone
says "each block moves alone"
