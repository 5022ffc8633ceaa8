# Rocks that fell one by one: the class says how many it sheds a year, the release points how many each of them does,
# and both give the same maps; with both at once nobody knows which decides.
mkdir points
run-probe . 12 blocks=3 independent=1 objects=watched
run-probe points 12 blocks=3 independent=1 weight=0.01 objects=watched
# narrower than the lanes of the boxes
sed 's/^width_m = 10/width_m = 5/' "$source_dir/share/hazard/switzerland_ti.toml" | tee points/narrow.toml >narrow.toml
printf '\n[hazard]\nrecipe = "narrow.toml"\n' | tee -a points/site.toml >>site.toml
cp site.toml plain.toml
printf '[hazard.class.V1]\nfrequency_per_a = 0.03\n' >>site.toml
printf '[hazard.class.V1]\n[rockfall.cliff]\nfrequency_per_a = 0.03\n' >>points/site.toml
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o class --json class.json
expect 0 talus-hazard points/site.toml points/run_*.h5 --trn points/slope.tif -o weights --json weights.json
# same_maps FOLDER FOLDER: all values; their tags name other runs
same_maps() {
  for file in "$1"/*.tif; do
    gdalinfo -checksum "$file" | grep Checksum >whole
    gdalinfo -checksum "$2/${file#"$1"/}" | grep Checksum | cmp - whole || fail "$file is another one in $2"
  done
}
same_maps class weights
for word in '"event": "rock"' '"frequency_per_a": 0.03'; do
  grep -q "$word" class.json && grep -q "$word" weights.json || fail "no $word in the results"
done
gdalinfo class/class.tif | grep -q 'FREQUENCIES=V1: 0.03 rocks a year' || fail 'the tags do not say what is counted'
grep -q 'rocks one by one hit what is 5 m wide across their paths' class.json || fail 'the pages do not say what is hit'
# each of the three boxes has a lane of its own: 0.01 a year, a third of the rocks
for of in event_frequency:0.01 passage_frequency:0.01 event_exceed:0.333; do
  value=$(gdallocationinfo -valonly -b 1 "class/${of%:*}.tif" 10 10)
  awk -v v="$value" -v w="${of#*:}" 'BEGIN { exit !(v > 0.995 * w && v < 1.005 * w) }' || fail "${of%:*}: $value, expected ${of#*:}"
done
expect 0 talus-reduce run_*.h5 --trn slope.tif -o part.h5
expect 0 talus-hazard site.toml part.h5 --trn slope.tif -o part
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o tiles --memory-mb 0.004
expect 0 talus-hazard site.toml part.h5 --trn slope.tif -o part_tiles --memory-mb 0.004
same_maps class part
same_maps class tiles
same_maps class part_tiles
expect 0 talus-reduce points/run_*.h5 --trn points/slope.tif -o points.h5
expect 0 talus-hazard points/site.toml points.h5 --trn points/slope.tif -o points_part
same_maps class points_part

# objects are hit as often as their cells say
expect 0 talus-trace site.toml run_*.h5 --trn slope.tif -o class.gpkg
prints 'house: hit by 33.3 % of the rocks (95 %: 0.138 - 0.609), once in 100 years'
expect 0 talus-trace points/site.toml points/run_*.h5 --trn points/slope.tif -o weights.gpkg
prints 'house: hit by 33.3 % of the rocks (95 %: 0.138 - 0.609), once in 100 years'

# a mass counts its runs: the same boxes, together
mkdir mass
run-probe mass 12 blocks=3
expect 0 talus-hazard site.toml mass/run_*.h5 --trn mass/slope.tif -o together
value=$(gdallocationinfo -valonly -b 1 together/event_frequency.tif 10 10)
[ "$(echo "$value" | cut -c1-4)" = 0.03 ] || [ "$(echo "$value" | cut -c1-6)" = 0.0299 ] || fail "event frequency of a mass: $value"

# two answers to one question, and what they say helps
refused() { words=$1; shift; expect 1 "$@"; says "$words"; nothing_left both/class.tif both.gpkg; }
refused 'hazard.class.V1: the blocks of the run have frequencies, and the class has one too' \
  talus-hazard site.toml points/run_*.h5 --trn points/slope.tif -o both
says 'without one of its own, the class counts each source by its frequency'
refused 'have frequencies, and the class has one too' talus-trace site.toml points/run_*.h5 --trn points/slope.tif -o both.gpkg
{ sed '/^frequency_per_a = /d' site.toml; printf '[rockfall.cliff]\nfrequency_per_a = 0.03\n'; } >way_out.toml
expect 0 talus-hazard way_out.toml points/run_*.h5 --trn points/slope.tif -o way_out
{ cat site.toml; printf '[rockfall.cliff]\nfrequency_per_a = 0.01\n'; } >both.toml
refused '[rockfall.cliff] has frequency_per_a' talus-hazard both.toml run_*.h5 --trn slope.tif -o both
run-probe mass 3 blocks=3 seed=1 objects=watched
refused 'run all of a class with solver.blocks = "alone", or none' talus-hazard site.toml run_*.h5 mass/run_0.h5 --trn slope.tif -o both

# without a frequency the share is still that of the rocks
expect 0 talus-hazard plain.toml run_*.h5 --trn slope.tif -o shares
value=$(gdallocationinfo -valonly -b 1 shares/event_exceed.tif 10 10)
[ "$(echo "$value" | cut -c1-5)" = 0.333 ] || fail "share of the rocks: $value"
