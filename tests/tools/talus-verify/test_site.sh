# Settings for a site's own scene: three boxes on a slope.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
sed -e 's/^height_above_ground_m.*//' -e 's/^spin_rad_s.*//' -e 's/^duration_s.*/duration_s = 1/' site.toml >flat.toml
mv flat.toml site.toml
make_blocks

study() { talus-verify --site site.toml --trn slope.tif --blocks blocks.h5 --runs 2 --no-db "$@"; }
expect 0 study -o s --tolerance 5%
prints "cheapest within 5%"
cp out s/out
grep -qx '\[solver\]' s/solver.toml || fail "solver.toml has no [solver]"
grep -qE '^time_step_s = 0\.' s/solver.toml || fail "solver.toml names no step"
grep -q '^site_centre,talus,18,' s/site.csv || fail "site.csv does not hold three rigid blocks"
grep -q "</svg>" s/site.svg || fail "no diagram"
# the settings found are read by talus-dda: they replace the site's own section
sed '/^\[solver\]/,$d' site.toml >found.toml
cat s/solver.toml >>found.toml
expect 0 talus-dda found.toml --trn slope.tif --blocks blocks.h5 --plan --no-db

# the reference is the result of talus-dda with the short step, but for the start of 1 mm/s
mean=$(sed -n 's/^Reference \([0-9.]*\) .*/\1/p' s/out)
talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o run.h5 --set solver.time_step_s=1e-3 --json --no-db >run.json
east=$(sed -n '/mean_displacement_m/{n;p;}' run.json | tr -d ' ,')
awk -v m="$mean" -v e="$east" 'BEGIN { exit !(e > 0.1 && m > 0.97 * e && m < 1.03 * e) }' ||
  fail "the reference is $mean m, talus-dda moves the blocks $east m"

# a setting whose runs break a limit of their health is not recommended, however cheap
sed 's/^\[solver\]/[solver]\nmax_penetration_m = 1e-6/' site.toml >limited.toml
expect 0 talus-verify --site limited.toml --trn slope.tif --blocks blocks.h5 --runs 2 --no-db -o limited --tolerance 100%
prints "| 2 of 2 |"
step=$(sed -n 's/^time_step_s = //p' limited/solver.toml)
awk -v h="$step" 'BEGIN { exit !(h > 0 && h < 0.01) }' || fail "steps of $step s are recommended"

# the law is in its outputs; blocks that overlap are refused as ever
sed 's/^\[solver\]/[solver]\nlaw = "paper"\nnormal_stiffness_n_m = 5e10/' site.toml >paper.toml
expect 0 talus-verify --site paper.toml --trn slope.tif --blocks blocks.h5 --runs 2 --no-db -o paper
grep -qx 'law = "talus"' paper/solver.toml || fail "solver.toml does not name the law"
grep -q "$(sed -n 's/^model name[^:]*: \([A-Za-z]*\).*/\1/p' /proc/cpuinfo | head -1)" paper/site.csv || fail "site.csv names no machine"
sed 's/^position_m = .*/position_m = [[500120, 5000030], [500120, 5000031.1]]/' site.toml >close.toml
talus-blocks close.toml --trn slope.tif -o close.h5 -q --no-db
expect 1 talus-verify --site close.toml --trn slope.tif --blocks close.h5 --runs 2 --no-db -o close
says "1 pair overlaps: block 0 and block 1 by"

# where the plan keeps strains the reference has them, and going without them is one of the settings
sed 's/^density_kg_m3 = 2600/&\nyoung_modulus_pa = 1e7/' site.toml >soft.toml
grep -q '^young_modulus_pa = 1e7' soft.toml || fail "no soft site"
expect 0 talus-verify --site soft.toml --trn slope.tif --blocks blocks.h5 --runs 2 --no-db -o soft --tolerance 5%
grep -q '^site_centre,talus,36,0.001,0,' soft/site.csv || fail "the reference of soft blocks has no strains"
grep -q '^site_centre,talus,18,0.01,0,' soft/site.csv || fail "soft blocks were not tried without strains"
prints "| without strains |"

expect 2 study -o bad --full
says "looks at the scene of a site file alone"
expect 2 study -o bad --page page.md
says "looks at the scene of a site file alone"
expect 2 study -o bad --tolerance much
says "expected a share above 0"
expect 2 talus-verify --site site.toml -o bad --no-db
says "needs a terrain and blocks"
expect 2 talus-verify slide_20 --tolerance 2% -o bad --no-db
exit 0
