# Blocks that break: pieces, parents, volumes and energies in the run file; maps and run-out of
# pieces; the same bytes when stopped and resumed. Off by default, and nothing is said of it then.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
breaking="--set fragmentation.enabled=true --set fragmentation.energy_j_m2=1e4"
touching() { talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db "$@"; }

expect 0 touching -o whole.h5 --json
cp out whole.json
expect 0 touching -o said.h5 $breaking
prints "breaks into two"
expect 0 touching -o broken.h5 $breaking --json
cp out broken.json
/usr/bin/python3 - <<'END' || fail "pieces do not add up to the blocks"
import json
whole, broken = json.load(open("whole.json")), json.load(open("broken.json"))
assert whole["n_breaks"] == 0 and whole["n_blocks"] == 3 and "fragments" not in whole, whole
n = broken["n_breaks"]
assert n > 0 and broken["n_blocks"] == 3 + n, broken
sizes = broken["fragments"]
assert sizes["n_pieces"] + sizes["n_unbroken"] == 3 + n and sizes["fracture_j"] > 0, sizes
assert all(check["pass"] for check in broken["health"] if check["check"].startswith("energy"))
END

# tools that evaluate runs read pieces, with the volume that was released
expect 0 talus-runout broken.h5 --trn slope.tif -o runout.gpkg --json runout.json --no-db
expect 0 talus-maps broken.h5 --trn slope.tif -o maps --no-db
/usr/bin/python3 - <<'END' || fail "the run-out table lost volume"
import json
volume = json.load(open("runout.json"))["balance"]
assert abs(volume["released_m3"] - 9) < 1e-6, volume
assert abs(volume["deposited_m3"] + volume["moving_m3"] + volume["left_domain_m3"] - 9) < 1e-6, volume
assert volume["n_released"] == 3 + json.load(open("broken.json"))["n_breaks"], volume
END

# stopped and resumed
slow="$breaking -q --set solver.time_step_s=0.0001 --set solver.duration_s=3 --set output.checkpoint_interval_s=0.02"
talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db -o stopped.h5 $slow &
run_id=$!
n=0
while [ ! -e stopped.h5.part ]; do
  n=$((n + 1))
  [ $n -lt 600 ] || fail "no checkpoint"
  sleep 0.05
done
kill -TERM $run_id || fail "the run was over before SIGTERM"
wait $run_id || true
[ -s stopped.h5.part ] || fail "no checkpoint after SIGTERM"
expect 0 touching -o stopped.h5 $slow --resume
expect 0 touching -o direct.h5 $slow
cmp direct.h5 stopped.h5 || fail "the resumed run differs from the whole one"

expect 1 touching -o joints.h5 $breaking --set fragmentation.splitting=joints
says "no face of a block is that of a joint set"
