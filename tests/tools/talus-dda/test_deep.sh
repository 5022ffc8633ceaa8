# A block that is in the ground by more than a tenth of its thickness: named with the body it is in,
# when and where, in the words of the tool and in its JSON.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
# law paper on springs so soft that the boxes sink
soft="--set solver.law=paper --set solver.time_step_s=0.001 --set solver.duration_s=0.6 --set solver.normal_stiffness_n_m=2e5"
expect 3 run_dda -o deep.h5 $soft --json
says "of the mass came in by more than a tenth of"
says "was in the ground by"
says "health: rocks in by more than a tenth of their thickness, share is"
says "or merge small blocks"
prints '"partner": "the ground"'
prints '"ends_in_toe"'
cp out deep.json
/usr/bin/python3 - <<'END' || fail "the JSON does not place the blocks on the map"
import json
answer = json.load(open("deep.json"))
deep = answer["deep_blocks"]
assert deep and all(row["depth_m"] > 0.1 * row["thickness_m"] for row in deep), deep
assert all(abs(row["position_m"][0] - 500000) < 1000 for row in deep), deep
share = next(c["value"] for c in answer["health"] if c["check"].startswith("rocks in by"))
assert abs(sum(row["mass_share"] for row in deep) - share) < 1e-12, share
END

# where a depth is given that will do, the run passes and says so all the same
expect 0 run_dda -o allowed.h5 $soft --set solver.max_penetration_m=5
says "of the mass came in by more than a tenth of"
