# As test_rocks, from the site file on: a source of 28 points that sheds 0.28 rocks a year is a class that sheds 0.28,
# and twice as many rocks at each point are a larger sample of the same.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
# rocks_of NAME N KEYS...: three runs of N rocks at each of 28 points, and the site file with KEYS
rocks_of() {
  mkdir "$1"
  {
    printf '[site]\nname = "rocks"\n[material.rock]\ndensity_kg_m3 = 2600\n[ground.ground]\nfriction_deg = 25\ncor = 0.4\n'
    printf '[solver]\nduration_s = 3\nmax_lost_share = 1\nstart_jitter_m_s = 0.5\n[output]\ncell_size_m = 5\n'
    printf '[rockfall.cliff]\nshape = "box"\nsize_m = [1, 0.8, 0.7]\nheight_above_ground_m = 0.5\nrocks = %s\n' "$2"
    printf 'position_m = ['
    for k in $(seq 28); do printf '[%s, %s],' $((500010 + k % 4)) $((5000014 + 2 * k)); done
    printf ']\n'
  } >"$1/site.toml"
  shift 2
  for words in "$@"; do printf '%s\n' "$words"; done >>"$name/site.toml"
  talus-blocks "$name/site.toml" --trn slope.tif -o "$name/blocks.h5" -q --no-db 2>/dev/null
  for seed in 1 2 3; do
    talus-dda "$name/site.toml" --trn slope.tif --blocks "$name/blocks.h5" -o "$name/run_$seed.h5" --seed $seed -q --no-db 2>/dev/null
  done
  expect 0 talus-hazard "$name/site.toml" "$name"/run_?.h5 --trn slope.tif -o "$name/hazard" --no-db
}
name=class && rocks_of class 1 '[hazard.class.V1]' 'frequency_per_a = 0.28'
name=points && rocks_of points 1 'frequency_per_a = 0.28' '[hazard.class.V1]'
for file in class/hazard/*.tif; do
  gdalinfo -checksum "$file" | grep Checksum >whole
  gdalinfo -checksum "points/${file#class/}" | grep Checksum | cmp - whole || fail "$file is another one by release points"
done
# both at once are refused before anything runs
sed 's/^rocks = .*/&\nfrequency_per_a = 0.28/' class/site.toml >both.toml
expect 1 talus-check both.toml --trn slope.tif --bed slope.tif --blocks class/blocks.h5 --probe-s 0 --no-db
says '[rockfall.cliff] has frequency_per_a'
# a point that sheds a rock each year is a frequency too
name=yearly && rocks_of yearly 1 'frequency_per_a = 28' '[hazard.class.V1]'

# where every rock passes, 0.28 a year in any sample
name=more && rocks_of more 4 '[hazard.class.V1]' 'frequency_per_a = 0.28'
for run in class more; do
  gdal_translate -q -b 1 -of XYZ $run/hazard/passage_frequency.tif $run.xyz
  awk '$3 > 0 { sum += $3 } END { print sum }' $run.xyz
done >sums
awk '{ v[NR] = $1 } END { exit !(v[1] > 0 && v[2] > 0.8 * v[1] && v[2] < 1.25 * v[1]) }' sums ||
  fail "rocks a year over all cells depend on the sample: $(cat sums)"
