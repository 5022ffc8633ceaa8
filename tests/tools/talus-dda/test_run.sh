# A run from end to end: outputs, figures that must hold, equal bytes, the plan.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs

expect 0 run_dda -o run.h5 --json
prints '"status": "done"'
prints '"n_blocks": 3'
prints '"n_crossings": 3'
prints '"n_frames": 81'
prints '"left_domain": 0'
nothing_left run.h5.part

# warnings stay with the run, and are on its maps
expect 0 run_dda -o fast.h5 --set solver.duration_s=1 --set material.rock.density_kg_m3=120
says "warning: 3 blocks move as if each were alone"
h5dump -d /warnings fast.h5 >kept
grep -q "3 blocks move as if each were alone" kept || fail "the run file does not hold the warning"
expect 0 talus-maps fast.h5 --trn slope.tif -o maps --no-db -q
gdalinfo maps/reach.tif >info
grep -q "WARNINGS=.*3 blocks move as if each were alone" info || fail "the maps do not say what was warned of"
grep -q "WARNINGS=.*$PWD" info && fail "a warning on a map holds a path"

# its id finds it in the registry
expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o registered.h5 --set solver.duration_s=0.1 --set solver.blocks=alone --db runs.sqlite --json
id=$(sed -n 's/.*"run_id": "\(.*\)".*/\1/p' out)
expect 0 talus-runs show "$id"
prints "registered.h5"

# the same bytes again
expect 0 run_dda -o again.h5 -q
cmp run.h5 again.h5 || fail "two runs of the same inputs differ"
[ -z "$(cat out)$(cat err)" ] || fail "-q is not quiet"

# another seed of jitter is another run
expect 0 run_dda -o jitter.h5 -q --seed 2 --set solver.start_jitter_m_s=0.01
cmp -s run.h5 jitter.h5 && fail "jitter changes nothing"

expect 0 run_dda -o seeded.h5 --seed 3 --set solver.duration_s=0.1
says "the seed draws nothing"

# an existing output stays
expect 1 run_dda -o run.h5
says "exists already"
expect 0 run_dda -o run.h5 --overwrite -q --set solver.duration_s=1

# the speed is known without passages; the summary shows the fault
expect 0 run_dda -o still.h5 --set output.passages=false --set solver.duration_s=2
grep -q "largest speed [1-9]" out || fail "no speed without passages"
grep -q "unconverged\|left the terrain" out && fail "trouble is said where there is none"
expect 0 run_dda -o gone.h5 --set solver.duration_s=20 --set ground.ground.friction_deg=0
grep -q "3 blocks left the terrain" out || fail "the summary does not say that blocks left the terrain"
expect 3 run_dda -o lost.h5 --set solver.duration_s=20 --set ground.ground.friction_deg=0 --set solver.max_lost_share=0
says "; take a larger terrain, or give max_lost_share"

# the checkpoint is an output like any other
cp blocks.h5 z.h5.part
expect 2 talus-dda site.toml --trn slope.tif --blocks z.h5.part --no-db -o z.h5 --overwrite --set solver.duration_s=0.1
says "z.h5.part: is both an input and an output"
cmp blocks.h5 z.h5.part || fail "an input is gone"
rm z.h5.part

# the plan: printed without a run, and as JSON
expect 0 run_dda --plan
prints "off  strains"
prints "on   crossings: 1 fence"
prints "off  base motion"
expect 0 run_dda --plan --json
prints '"item": "strains"'
expect 0 run_dda --plan=full -o full.h5 --json --set solver.duration_s=1
prints '"reason": "the full plan was asked for"'
expect 1 run_dda --plan=half -o half.h5
says "expected full or nothing"
expect 0 run_dda -o run2.h5 --passages-by centroid -q
cmp -s run2.h5 again.h5 && fail "passages by centroid change nothing"
exit 0
