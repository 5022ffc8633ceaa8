# A failure surface that comes out at the foot: found from the joint sets, or refused with reasons.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site '[ground.rock]'
daylighting() { blocks --set source.failure_surface=daylighting "$@"; }

expect 0 daylighting --report r.json --trn-out bed.tif
prints "failure plane of set sliding: dips 35 degrees towards 180, 5 degrees steeper than friction"
holds "$(value r.json free_share_of_foot) >= 0.9"
holds "$(value r.json largest_step_at_foot_m) < 0.2"
holds "$(value r.json largest_depth_m) > 2"
rm blocks.h5

# Why each set cannot, and the remedy.
expect 1 daylighting --set ground.rock.friction_deg=36
says "no joint set makes a failure surface that daylights at the foot of the source, where the slope dips 40 degrees towards 180"
says "sliding (35 degrees towards 180) is no steeper than the friction angle of 36 degrees"
nothing_left blocks.h5
expect 1 daylighting --set joints.sliding.dip_deg=44
says "sliding (44 degrees towards 180) is steeper than the slope, which dips 40 degrees in that direction"
expect 1 daylighting --set source.sliding_set=rear
says "set rear does not make a failure surface"
sed '/^\[joints/,/^$/d' site.toml >bare.toml
expect 1 talus-blocks bare.toml --trn trn.tif -o blocks.h5 --no-db --set source.failure_surface=daylighting
says 'failure_surface = "daylighting" needs [joints.*]'
nothing_left blocks.h5

# The friction is that of the ground below the source, independent of the ground elsewhere.
make_site '[ground.smooth]' 'friction_deg = 20' '[ground.rough]' 'friction_deg = 36' \
  'polygon = [[500010, 5200010], [500036, 5200010], [500036, 5200036], [500010, 5200036]]'
expect 1 daylighting
says "friction angle of 36 degrees"
make_site '[ground.rough]' 'friction_deg = 45' '[ground.smooth]' 'friction_deg = 20' \
  'polygon = [[500010, 5200010], [500036, 5200010], [500036, 5200036], [500010, 5200036]]'
expect 0 daylighting --overwrite
prints "15 degrees steeper than friction"

# A stage of make depends on friction where the surface does.
talus-site site.toml -o plain -q --no-db
talus-site site.toml -o found -q --no-db --set source.failure_surface=daylighting
if grep -q '^ground' plain/blocks.txt; then fail "the blocks depend on the ground without need"; fi
grep -q '^ground.rough.friction_deg = 45' found/blocks.txt || fail "the blocks do not depend on the ground"

# A plane given by hand that does not come out is warned of.
hand() {
  blocks --overwrite --set source.failure_surface=plane --set source.plane_dip_deg=35 \
    --set source.plane_dip_direction_deg=180 --set "source.plane_point_m=[500020,5200012,$1]"
}
expect 0 hand 105
says "the failure plane comes out of the ground along 0 % of the foot of the source only"
expect 0 hand 111
if grep -q 'comes out of the ground' err; then fail "a plane that comes out is warned of"; fi
