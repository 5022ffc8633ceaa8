# Runs that are missing or were made with other inputs are made; the rest is left as it is.
. "$source_dir/tests/tools/talus-batch/common.sh"
made_again 3 --runs 3 --jobs 2
says "runs: 3 done, 0 failed, 0 to go"
[ "$(outcomes)" = done,done,done ] || fail "outcomes: $(outcomes)"
made_again 0 --runs 3
cp results/runs/ensemble.json first.json
touch -d '+40 seconds' results/runs/run_1.h5
made_again 0 --runs 3
cmp first.json results/runs/ensemble.json || fail "ensemble.json depends on times"
made_again 2 --runs 5
made_again 0 --runs 3
cmp first.json results/runs/ensemble.json || fail "fewer runs give another ensemble"

# a setting, an option, a file by hand, other blocks
cp results/runs/run_1.h5 kept.h5
sed -i 's/^friction_deg = 20/friction_deg = 21/' site.toml
expect 0 batch --runs 3 --status --part 0/2
[ "$(cat out)" = "stale 3 1-2 4 3" ] || fail "status: $(cat out)"
made_again 3 --runs 3
says "is made again: it was made with other settings: ground.ground.friction_deg: 21, there 20"
made_again 3 --runs 3 -- --set solver.blocks=alone
cp results/runs/run_1.h5 results/runs/run_2.h5
made_again 1 --runs 3 -- --set solver.blocks=alone
cp kept.h5 results/runs/run_3.h5
made_again 1 --runs 3 -- --set solver.blocks=alone
truncate -s -7 results/runs/run_3.h5
made_again 1 --runs 3 -- --set solver.blocks=alone
sed -i 's/^size_m = .*/size_m = [2, 1.5, 1.1]/' site.toml
talus-blocks site.toml --trn results/bed.tif -o results/blocks.h5 -q --no-db --overwrite
made_again 3 --runs 3 -- --set solver.blocks=alone
sed -i '1i # a remark' site.toml
talus-blocks site.toml --trn results/bed.tif -o results/blocks.h5 -q --no-db --overwrite
made_again 0 --runs 3 -- --set solver.blocks=alone
expect 0 batch --runs 3 --status --part 0/2 -- --set solver.blocks=alone
[ "$(cat out)" = "current 0 - 4 3" ] || fail "status: $(cat out)"

# runs, another folder, and the tools that take it
made_again 2 --runs 2 --into without -- --set solver.blocks=alone --set fence.low.active=true
expect 0 talus-maps results/runs --trn results/bed.tif -o maps --no-db
gdalinfo maps/reach.tif | grep -q 'N_RUNS=3$' || fail "the folder does not stand for its runs"
rm results/runs/ensemble.json results/runs/run_[45].h5  # without a plan all count
expect 0 talus-runout results/runs --trn results/bed.tif -o runout.gpkg --no-db
[ -s results/runs/ensemble.json ] || fail "ensemble.json was not made again"

# as with every tool
expect 2 batch --runs many
says "is many, expected a whole number, 1 or more, or auto"
expect 2 batch --part 3/2
says "is 3/2, expected K/N with K up to N"
expect 1 talus-batch site.toml --results nowhere --no-db --runs 1
says "nowhere"
