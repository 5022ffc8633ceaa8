# make looks before it runs: an implausible site ends it with a page, each time, until it is
# accepted.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
made slope check
prints "will it move: "
[ -s slope/out/check.html ] && [ -s slope/out/check.json ] || fail "no page"
[ ! -e slope/out/runs/run_1.h5 ] || fail "a run was computed"
made slope check
if grep -q "will it move" out; then fail "the look was taken again"; fi
made slope runs
if grep -q "will it move" out; then fail "the look was taken again"; fi

site deep
# The failure plane some 80 m below the ground
sed -i 's/^\(plane_point_m = \[[^,]*,[^,]*, *\)[-0-9.]*/\1-20/' deep/site.toml
for time in first second; do
  expect 2 make -C deep BIN=
  says "deep on average"
  [ -s deep/out/check.html ] || fail "no page the $time time"
  [ ! -e deep/out/runs/run_1.h5 ] || fail "a run was computed the $time time"
done
made deep check CHECK_FLAGS='--accept-doubts --probe-s 0'
says "source.plane_point_m: the mass is"

# Rocks on a grid, closer than they are wide: none meets another in runs that move each alone.
site rocks
awk '/^\[/ { kept = !/^\[joints/ } kept && !/^(failure_surface|plane_)/' slope/site.toml >rocks/site.toml
cat >>rocks/site.toml <<'END'

[blocks.rock]
shape = "rock"
size_m = [6, 5, 4]
position_m = [[500110, 5200270], [500113, 5200270]]
height_above_ground_m = 0.5
END
expect 2 make -C rocks BIN= check
says "pair overlaps" 'solver.blocks = "alone"'
printf '[solver]\nblocks = "alone"\n' >alone && sed -i 's/^\[solver\]$/&\nblocks = "alone"/' rocks/site.toml
grep -q '^blocks = "alone"' rocks/site.toml || cat alone >>rocks/site.toml
made rocks check
grep -q '"moved_share"' rocks/out/check.json || fail "no forecast of rocks that fall alone"
made rocks check
if grep -q "will it move" out; then fail "the look was taken again"; fi
