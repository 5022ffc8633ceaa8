# Variables that make is given are checked before anything runs: the messages say the value found
# and the one expected.
. "$source_dir/tests/tools/pipeline/common.sh"
site "a slope"
mkdir "a slope/2" "a slope/out"
# refused TEXT ARGUMENTS...
refused() {
  text=$1
  shift
  expect 2 make -C "a slope" BIN= "$@"
  says "$text"
  nothing_left "a slope/out/stages"
  [ -d "a slope/2" ] && [ -d "a slope/out" ] || fail "a folder was removed by make $*"
}
for goal in clean all; do
  refused "OUT is 'out 2', expected the name of a folder without blanks" OUT="out 2" $goal
  refused "OUT is '', expected the name of a folder" OUT= $goal
  refused "OUT is out;rm, expected the name of a folder without ;" OUT="out;rm" $goal
done
refused "WITHOUT is 'maybe', expected yes or no" WITHOUT=maybe
refused "DEM is 'a:b.tif', whose colon or blank make would take for its own" DEM=a:b.tif
refused "DEM is 'a b.tif', whose colon or blank" DEM="a b.tif"
refused "CONTOURS is 'a:b.gpkg|layername=x y', whose colon" CONTOURS="a:b.gpkg|layername=x y"
# variables for talus-batch
wrong() {
  expect 2 make -C "a slope" BIN= "$@"
  says "The runs cannot be made, see above: what is wrong with RUNS"
}
for runs in abc 0 -2 1.5 "1 2"; do wrong RUNS="$runs" && says "is $runs, expected a whole number"; done
for seed in abc -2; do wrong SEED="$seed"; done
# variables that replaced cases
expect 2 make -C "a slope" BIN= CASES='low high' WEIGHTS='low=1 high=3' CASE_low='--set ground.slope.friction_deg=24' \
  CASE_high='--set solver.friction=weakening'
prints '[variant.low]
weight = 1
ground.slope.friction_deg = 24
[variant.high]
weight = 3
solver.friction = "weakening"'
says "CASES, CASE_* and WEIGHTS are gone: write the lines above in site.toml"

made "a slope" -n RUNS=10 SEED=0 WITHOUT=no
prints "--into runs --runs '10' --seed '0'"
made "a slope" terrain
made "a slope" clean
nothing_left "a slope/out"
