# Impossible inputs are refused before anything is computed, with where and a remedy; nothing is
# left.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs

# refuses TEXT OPTIONS...: exit 1 (or $fault), the text, no output
refuses() {
  wanted=$1
  shift
  expect "${fault:-1}" run_dda -o run.h5 "$@"
  says "$wanted"
  nothing_left run.h5 run.h5.part
}

fault=2  # values on the command line
refuses "friction_deg is 90, expected 0 to below 90" --set ground.ground.friction_deg=90
refuses "friction_deg is 95, expected 0 to below 90" --set ground.ground.friction_deg=95
refuses "cor is 1.5, expected 0 to 1" --set ground.ground.cor=1.5
refuses "cor is -0.1, expected 0 to 1" --set ground.ground.cor=-0.1
refuses "time_step_s is 0, expected above 0" --set solver.time_step_s=0
refuses "time_step_s is -1" --set solver.time_step_s=-1
refuses "duration_s is 0" --set solver.duration_s=0
refuses "density_kg_m3 is 0" --set material.rock.density_kg_m3=0
refuses "law" --set solver.law=newton
fault=1
expect 2 run_dda -o run.h5 --no-such-option
expect 2 run_dda
says "no output is named"

# times: a run is whole steps
refuses "duration_s is 0.4, less than a time step of 1 s" --set solver.duration_s=0.4 --set solver.time_step_s=1

# work without end
refuses "output.cell_size_m: cells of 0.001 m are 1.5e+10 cells on this terrain" --set output.cell_size_m=0.001
refuses "posts every 1e-05 m are 8e+06 posts" --set fence.low.post_spacing_m=1e-5

# messages on settings that do not fit together
refuses "give [solver] normal_stiffness_n_m" --set solver.law=paper --set solver.duration_s=1
fault=2
refuses "did you mean ground.ground?" --set ground.grund.cor=1
fault=1
refuses "a harmonic motion has no amplitude" --set base_motion.frequency_hz=2

# base motion
printf 'time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n5,1,0,0\n' >short.csv
refuses "the base motion ends at 5 s, the run lasts 8 s" --set base_motion.file=short.csv
printf 'time_s,ax_m_s2,ay_m_s2\n0,0,0\n9,1,0\n' >column.csv
refuses "has no column az_m_s2" --set base_motion.file=column.csv
printf 'time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n5,1,0,x\n' >word.csv
refuses 'az_m_s2 is "x", expected a number' --set base_motion.file=word.csv
printf 'time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n5,1,0,0\n5,1,0,0\n' >still.csv
refuses "time_s is 5, expected above 5" --set base_motion.file=still.csv

# odd fences, a section given twice
cp site.toml kept.toml
printf '[fence.twice]\nline = [[500080, 5000010], [500080, 5000010], [500080, 5000090]]\n' >>site.toml
refuses "point 2 repeats the one before, (500080, 5000010)"
cp kept.toml site.toml
printf '[fence.low]\nheight_m = 3\n' >>site.toml
refuses "a section or key is in the file twice"
cp kept.toml site.toml

# fence off the terrain
printf '[fence.high]\nline = [[500080, 5000010], [500280, 5000090]]\n' >>site.toml
refuses "leaves the known terrain at"
make_site

# blocks that do not belong to the terrain
sed 's/^xllcenter.*/xllcenter 600000/' plane.asc >far.asc
talus-trn far.asc -o far.tif --crs EPSG:32632 -q --no-db
expect 1 talus-dda site.toml --trn far.tif --blocks blocks.h5 -o run.h5 --no-db --set solver.blocks=alone
says "outside the terrain"
talus-trn plane.asc -o other.tif --crs EPSG:32633 -q --no-db
expect 1 talus-dda site.toml --trn other.tif --blocks blocks.h5 -o run.h5 --no-db --set solver.blocks=alone
says "the terrain other.tif is in EPSG:32633"
nothing_left run.h5

# in the ground: refused with how deep, or lifted
awk 'NR <= 6 { print; next } { for (i = 1; i <= NF; i++) $i += 1.25; print }' plane.asc >raised.asc
talus-trn raised.asc -o raised.tif --crs EPSG:32632 -q --no-db
expect 1 talus-dda site.toml --trn raised.tif --blocks blocks.h5 -o run.h5 --no-db --set solver.blocks=alone
says "3 of 3 blocks start below the ground"
says "by 0.75"
says "is not the terrain that blocks.h5 was made for"
says "--settle lifts"
expect 0 talus-dda site.toml --trn raised.tif --blocks blocks.h5 -o settled.h5 --no-db --set solver.blocks=alone --settle --set solver.duration_s=1
says "lifted onto it"
says "warning: raised.tif is not the terrain that blocks.h5 was made for"

# damaged or foreign block sets
head -c 3000 blocks.h5 >cut.h5
expect 1 talus-dda site.toml --trn slope.tif --blocks cut.h5 -o run.h5 --no-db --set solver.blocks=alone
says "cut.h5"
expect 1 talus-dda site.toml --trn slope.tif --blocks settled.h5 -o run.h5 --no-db --set solver.blocks=alone
says "settled.h5"
sed 's/material.rock/material.granite/' site.toml >granite.toml
expect 1 talus-dda granite.toml --trn slope.tif --blocks blocks.h5 -o run.h5 --no-db --set solver.blocks=alone
says "the blocks are of material rock, which the site file does not have"

# a box without a volume
sed 's/^size_m = .*/size_m = [1e-100, 1e-100, 1e-100]/' site.toml >flat.toml
expect 1 talus-blocks flat.toml --trn slope.tif -o flat.h5 --no-db
says "blocks.a: the box has 1e-300 m3"
nothing_left flat.h5

# a broken limit: exit 3, said which, and the file is kept
expect 3 run_dda -o limit.h5 --set solver.max_penetration_m=1e-12
says "largest penetration, m"
says "; take a smaller time_step_s, or give max_penetration_m"
[ -s limit.h5 ] || fail "the file of a failed run was not kept"

# Blocks that pass through each other are not a result, unless asked for by name, and then said.
expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o paper.h5 --no-db --set solver.law=paper --set solver.normal_stiffness_n_m=5e10 --set solver.duration_s=0.1
expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o together.h5 --no-db --set solver.duration_s=0.1
expect 0 run_dda -o alone.h5 --set solver.duration_s=0.1
says "warning: 3 blocks move as if each were alone"
exit 0

# a spin that no step can follow is refused before the run, independent of the writer of the block
# set
sed 's/^spin_rad_s.*/spin_rad_s = [1e9, 1, 0]/' site.toml >spins.toml
grep -q 1e9 spins.toml || fail "no spin in the site file"
expect 0 talus-blocks spins.toml --trn slope.tif -o spins.h5 --no-db
expect 1 talus-dda spins.toml --trn slope.tif --blocks spins.h5 -o spins_run.h5 --no-db
says "block 0: spins at the start with 1e+09 rad/s, expected at most 1000"
