# Runs that shards reduced to parts give the bytes of one make, report and project included: with
# cases, fences, objects, places, classes of hazard; and of runs that keep no frames but for a share
# of them.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
sed -i 's/^duration_s = .*/duration_s = 0.2/' slope/site.toml
cat >>slope/site.toml <<'TOML'

[place.foot]
polygon = [[500100, 5200200], [500140, 5200200], [500140, 5200250], [500100, 5200250]]
[object.road]
position_m = [500120, 5200260]
radius_m = 30
[hazard.class.low]
frequency_per_a = 0.01
[hazard.class.high]
frequency_per_a = 0.001
TOML
variants slope '[variant.low]\nweight = 3\nground.slope.friction_deg = 24
[variant.high]\nweight = 1\nground.slope.friction_deg = 32'
site whole
cp slope/site.toml whole
# both_ways VARIABLES...
both_ways() {
  made slope "$@" prepare
  for k in 1 2; do made slope "$@" SHARD=$k SHARDS=2 runs-shard; done
  made slope "$@"
  made whole "$@" -j2
  same_results slope whole
  made slope "$@"
  prints "Nothing to be done for 'all'"
}
both_ways RUNS=2
for kind in runs without; do
  [ "$(grep -c -- '-of-2.h5"' slope/out/$kind/ensemble.json)" -eq 2 ] || fail "the results are not made from parts"
done

# Seeds 1 and 3 keep their frames.
sed -i '/^\[hazard/,$d' slope/site.toml
printf '[output]\nframes = false\nwhole_share = 0.5\n' >>slope/site.toml
cp slope/site.toml whole
for folder in slope whole; do made $folder clean; done
both_ways RUNS=3 WITHOUT=no
# no run keeps its frames
sed -i '/^whole_share/d' slope/site.toml whole/site.toml
both_ways RUNS=2 WITHOUT=no
made slope clean
nothing_left slope/out
