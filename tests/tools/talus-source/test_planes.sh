# Which planes of the joint sets come out of the slope; sections for joints that nobody measured.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site '[ground.rock]'

expect 0 talus-source site.toml --trn trn.tif -o source.json --no-db
prints "slope: dips 40 degrees towards 180; friction of the ground 30 degrees"
prints "sliding (35 degrees towards 180): "
prints "5 degrees steeper than friction; comes out of the ground along 9"
prints "rear (80 degrees towards 10): dips into the slope"
prints "lateral (85 degrees towards 95): dips across the slope, 85 degrees off its fall line"
[ "$(sed -n 's/.*"taken": "\(.*\)",/\1/p' source.json)" = sliding ] || fail "not the plane of sliding"

# Dry, a plane holds by tan(30) / tan(35), and with water and in an earthquake by less.
prints "sliding by limit equilibrium: factor of safety 0.825 dry"
printf '[water]\ndepth_m = 1\ndrained = ["source_side"]\n' | cat site.toml - >wet.toml
holds_factors() { python3 -c "
import json, math
row, = json.load(open('$1'))['limit_equilibrium']
tan = lambda d: math.tan(math.radians(d))
assert $2, row" || fail "$1: $2"; }
expect 0 talus-source wet.toml --trn trn.tif -o wet.json --no-db --set ground.rock.friction_deg=60
prints "sliding (35 degrees towards 180): is no steeper than the friction angle of 60 degrees"
prints "with the water of [water]; holds up to a seismic coefficient of"
holds_factors wet.json "abs(row['dry'] / (tan(60) / tan(35)) - 1) < 1e-9 and 1 < row['wet'] < row['dry']"
# (cos d - k sin d - u) tan phi = sin d + k cos d, with u from the factor
holds_factors wet.json "abs(row['critical_seismic_coefficient'] - (row['wet'] - 1) * tan(35) / (1 + tan(60) * tan(35))) < 1e-6"

# The volume is that which talus-blocks finds for it.
expect 0 blocks --set source.failure_surface=daylighting --report blocks.json
holds "$(value blocks.json prism_volume_m3) == $(value source.json volume_m3)"

# The mass that would leave, as an area: of the volume that is cut but for the part that each cell
# that the plane comes out in hides.
expect 0 talus-source site.toml --trn trn.tif -o source.json --layers source.gpkg --no-db --overwrite
holds "($(value source.json outlined_m3) / $(value source.json volume_m3) - 1) ^ 2 < 0.02 ^ 2"
ogrinfo -q -sql "select sum(st_area(geom)) as a, sum(taken) as n from failure_surfaces" source.gpkg >layer
grep -q 'n (Integer.*) = 1' layer || { cat layer; fail "not one surface is taken"; }
a=$(sed -n 's/.*a (Real) = //p' layer)
holds "$a > 100 && $a < $(value source.json volume_m3)"
[ "$(ogrinfo -q -sql "select count(*) as n from planes_by_share_of_foot" source.gpkg | sed -n 's/.*n (Integer.*) = //p')" = 5 ] ||
  fail "not five shares of the foot"
python3 "$source_dir/tests/tools/fields.py" "$source_dir/docs/reference/fields.md" source.gpkg || fail "fields"
cp source.gpkg first.gpkg
expect 0 talus-source site.toml --trn trn.tif --layers source.gpkg --no-db --overwrite
cmp -s source.gpkg first.gpkg || fail "another layer for the same inputs"

expect 0 talus-source site.toml --trn trn.tif --no-db --set ground.rock.friction_deg=39.5
prints "sliding (35 degrees towards 180): is no steeper than the friction angle of 39.5 degrees"
prints "the slope is no steeper than friction"

# Sections for the site file: cut, they make about the blocks that were asked for.
sed '/^failure_surface/,$d' site.toml >bare.toml
printf '\n[ground.slope]\nfriction_deg = 28\n' >rest.toml
cat bare.toml rest.toml >asked.toml
expect 0 talus-source asked.toml --trn trn.tif --assume-joints joints.toml --blocks 40 --no-db
prints "joint sets are assumed from the slope"
grep -q '^dip_deg = 36$' joints.toml || fail "not two thirds of the way from 28 to 40 degrees"
cat bare.toml joints.toml rest.toml >site.toml
expect 0 blocks --report blocks.json --overwrite
holds "$(value blocks.json n_blocks) >= 25 && $(value blocks.json n_blocks) <= 100"
prints "failure plane of set sliding: dips 36 degrees towards 180, 8 degrees steeper than friction"

sed 's/friction_deg = 28/friction_deg = 38/' asked.toml >rough.toml
expect 0 talus-source rough.toml --trn trn.tif --assume-joints none.toml --no-db
prints "no plane daylights at the foot of the source"
grep -q '^failure_surface = "normal_depth"' none.toml || fail "no surface was given instead"
grep -q 'NO PLANE DAYLIGHTS' none.toml || fail "the file does not warn"

sed '/^polygon/d; /^\[source\]/d' asked.toml >nothing.toml
expect 1 talus-source nothing.toml --trn trn.tif --no-db
says "there is no [source] with a polygon"
