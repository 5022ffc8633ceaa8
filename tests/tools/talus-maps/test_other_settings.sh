# Runs that were made with other settings are not trials of one thing: every tool that evaluates
# them refuses them, with the keys that differ.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
dda() {
  out=$1
  shift
  talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db -q --set solver.duration_s=1 -o "$out" "$@"
}
mkdir x
for seed in 1 2; do dda x/run_$seed.h5 --set solver.blocks=alone --seed $seed --set solver.start_jitter_m_s=0.1; done
same="--set solver.blocks=alone --set solver.start_jitter_m_s=0.1"
expect 0 talus-maps x/run_1.h5 x/run_2.h5 --trn slope.tif -o maps --no-db

# refused KEY FILE...: with all tools that need no site file
refused() {
  key=$1
  shift
  for tool in "maps -o m" "runout -o m.gpkg" "reduce -o m.h5"; do
    # shellcheck disable=SC2086
    expect 1 talus-${tool%% *} "$@" --trn slope.tif ${tool#* } --no-db
    says "$key"
    nothing_left m/reach.tif m.gpkg m.h5
  done
}
other="was computed with other settings than x/run_1.h5: "

# by --set, by an option for a key, by an option that is not a key, by the content of a file
dda x/run_3.h5 $same --seed 3 --set ground.ground.friction_deg=10
refused "x/run_3.h5: ${other}ground.ground.friction_deg: 10, there 20" x/run_1.h5 x/run_2.h5 x/run_3.h5
dda x/run_4.h5 $same --seed 4 --set solver.accuracy=0.05
refused "${other}solver.accuracy: 0.05, there " x/run_1.h5 x/run_4.h5
dda x/run_5.h5 --set solver.start_jitter_m_s=0.1 --seed 5 --passages-by centroid
refused "${other}--passages-by: centroid, there footprint; solver.blocks: 'auto', there 'alone'" x/run_1.h5 x/run_5.h5
classes() {
  awk -v last="$1" 'BEGIN {
    print "ncols 30\nnrows 20\nxllcorner 500002.5\nyllcorner 5000002.5\ncellsize 5"
    for (r = 0; r < 20; r++) { for (c = 0; c < 30; c++) printf "%s ", r == 19 && c == 29 ? last : 1; print "" }
  }' >classes.asc
}
mkdir by_class
sed -e 's/^\[ground.ground\]/[terrain]\nground_raster = "classes.asc"\n&/' site.toml >classed.toml
printf '[ground.%s]\nraster_values = [%d]\nfriction_deg = 20\n' one 1 other 2 >>classed.toml
for last in 1 2; do
  classes $last
  talus-dda classed.toml --trn slope.tif --blocks blocks.h5 --no-db -q --set solver.duration_s=1 --set solver.blocks=alone --seed $last -o by_class/run_$last.h5
done
expect 1 talus-maps by_class/run_1.h5 by_class/run_2.h5 --trn slope.tif -o m --no-db
says "by_class/run_2.h5: was computed with other settings than by_class/run_1.h5: file ground_raster: "

# other blocks under the same name
cp blocks.h5 first.h5
sed -i 's/^size_m = .*/size_m = [2, 1.5, 1.1]/' site.toml
talus-blocks site.toml --trn slope.tif -o blocks.h5 -q --no-db --overwrite
dda x/run_6.h5 $same --seed 6
refused "${other}blocks.a.size_m: [2, 1.5, 1.1], there [2, 1.5, 1]" x/run_1.h5 x/run_6.h5
sed -i 's/^size_m = .*/size_m = [2, 1.5, 1]/' site.toml
dda x/run_7.h5 $same --seed 7
refused "x/run_7.h5: was computed with other blocks than x/run_1.h5" x/run_1.h5 x/run_7.h5
mv first.h5 blocks.h5

# in parts, and in parts of parts
for run in 1 3; do expect 0 talus-reduce x/run_$run.h5 --trn slope.tif -o part_$run.h5 --no-db; done
refused "part_3.h5 (x/run_3.h5): was computed with other settings than part_1.h5 (x/run_1.h5): ground.ground.friction_deg: 10, there 20" part_1.h5 part_3.h5
expect 0 talus-reduce part_1.h5 x/run_2.h5 --trn slope.tif -o part.h5 --no-db
refused "ground.ground.friction_deg: 10, there 20" part.h5 part_3.h5

# The remedies: each alone, or as cases, which differ in keys of the command line alone.
expect 0 talus-maps x/run_3.h5 --trn slope.tif -o alone --no-db
mkdir -p cases/hard cases/soft
cp site.toml plain.toml
printf '[variant.hard]\nweight = 1\n[variant.soft]\nweight = 1\nground.ground.friction_deg = 10\n' >>site.toml
dda cases/hard/run_1.h5 $same --seed 1 --variant hard
dda cases/soft/run_3.h5 $same --seed 3 --variant soft
expect 0 talus-maps cases --trn slope.tif -o cases_maps --no-db
says "runs of 2 cases pooled, each run alike: no probability"
sed 's/^friction_deg = 20/friction_deg = 10/' site.toml >soft.toml
talus-dda soft.toml --trn slope.tif --blocks blocks.h5 --no-db -q --set solver.duration_s=1 $same --seed 4 --variant soft -o soft_4.h5
expect 0 talus-maps cases/soft/run_3.h5 soft_4.h5 --trn slope.tif -o soft --no-db
sed '/^ground.ground/d' soft.toml >softer.toml
talus-dda softer.toml --trn slope.tif --blocks blocks.h5 --no-db -q --set solver.duration_s=1 $same --seed 4 --variant soft -o soft_5.h5
expect 1 talus-maps cases/hard/run_1.h5 soft_5.h5 --trn slope.tif -o m --no-db
says "ground.ground.friction_deg: 10, there 20"
cp plain.toml site.toml

# Samples differ in the values that they draw. A run without a sample is of another distribution.
printf '[uncertainty.f]\nkeys = ["ground.ground.friction_deg"]\ndistribution = "uniform"\nmin = 15\nmax = 25\n' >>site.toml
mkdir drawn
for seed in 1 2; do dda drawn/run_$seed.h5 --set solver.blocks=alone --seed $seed --sample $seed; done
expect 0 talus-maps drawn/run_1.h5 drawn/run_2.h5 --trn slope.tif -o drawn/maps --no-db
dda drawn/run_3.h5 --set solver.blocks=alone --seed 3
expect 1 talus-maps drawn/run_1.h5 drawn/run_3.h5 --trn slope.tif -o m --no-db
says "ground.ground.friction_deg: 20, there "
dda drawn/run_4.h5 --set solver.blocks=alone --seed 4 --sample 4 --set uncertainty.f.max=26
expect 1 talus-maps drawn/run_1.h5 drawn/run_4.h5 --trn slope.tif -o m --no-db
says "uncertainty.f.max: 26, there 25"

# Runs with and without fences differ in these alone.
sed -i '/^\[uncertainty/,$d' site.toml
mkdir stands
dda stands/run_1.h5 $same --seed 1 --set fence.low.active=true
dda stands/run_2.h5 $same --seed 2 --set fence.low.active=true
fence() { expect "$1" talus-fence site.toml --trn slope.tif stands/run_1.h5 stands/run_2.h5 --without "$2" -o fence.gpkg --no-db --overwrite; }
fence 0 x/run_1.h5
fence 1 x/run_3.h5
says "x/run_3.h5: was computed with other settings than stands/run_1.h5: ground.ground.friction_deg: 10, there 20"
