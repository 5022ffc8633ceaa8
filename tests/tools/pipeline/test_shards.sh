# Runs in shards: together they are the runs of `make runs`, with one registry; a shard makes nothing
# that other shards read, and brings its runs together in a part, from which results have the same
# bytes. The counts of parts: tests/tools/talus-batch/test_parts.sh
. "$source_dir/tests/tools/pipeline/common.sh"
few='RUNS=5 WITHOUT=no'
# shard NUMBER ARGUMENTS...
shard() {
  k=$1
  shift
  # shellcheck disable=SC2086  # words of make
  made slope $few SHARD="$k" SHARDS=2 "$@" runs-shard
}
refused() {
  text=$1
  shift
  # shellcheck disable=SC2086
  expect 2 make -C slope BIN= $few "$@"
  says "$text"
}
site slope
sed -i 's/^duration_s = .*/duration_s = 0.1/' slope/site.toml

# inputs of a shard are made before, by one make
refused "shards only compute runs: make prepare" SHARD=1 SHARDS=2 runs-shard
made slope $few prepare
prints "runs: 5 to make"
[ -s slope/out/blocks.h5 ] || fail "prepare made no blocks"
[ -z "$(find slope/out -name 'run_*.h5')" ] || fail "prepare made runs"
shard 1
[ "$(cd slope/out/runs && echo run_*.h5)" = "run_1.h5 run_3.h5 run_5.h5" ] || fail "shard 1 made $(ls slope/out/runs)"
says "runs: 3 done, 0 failed, 0 to go"
[ -s slope/out/parts/1-of-2.h5 ] || fail "shard 1 made no part"
made slope $few prepare
prints "runs: 2 to make"
shard 2
[ ! -e slope/out/shards/merged ] || fail "a shard merged registries"
made slope $few prepare
prints "runs: 0 to make"
made slope $few -j2 maps runout
made slope $few maps runout
prints "Nothing to be done for 'maps'"
expect 0 talus-runs --db slope/out/runs.sqlite list --summary --json
python3 -c '
import json
tools = {t["tool"]: t for t in json.load(open("out"))["tools"]}
assert tools["talus-dda"]["n_done"] == 5, tools
' || fail "the registry does not hold each run once"
expect 0 talus-runs trace slope/out/maps/reach.tif
prints "--seed 5 "
grep -q '"../parts/2-of-2.h5"' slope/out/runs/ensemble.json || fail "the ensemble has no parts"

# the bytes of one make
site whole
cp slope/site.toml whole
made whole $few -j2 maps runout
same_results slope whole

# a node died while it wrote the log of its shard: the maps come, and the log is named
rm -f slope/out/shards/2-of-2.sqlite-* slope/out/maps/reach.tif
truncate -s "$(($(stat -c %s slope/out/shards/2-of-2.sqlite) / 2))" slope/out/shards/2-of-2.sqlite
made slope $few maps
says "2-of-2.sqlite: the run registry cannot be used"
[ -s slope/out/maps/reach.tif ] || fail "no map for the sake of a log"
rm slope/out/shards/*.sqlite

# another site file: not made by a shard; another seed range: only missing runs
cp slope/site.toml kept.toml
sed -i 's/^spacing_m = 7.8/spacing_m = 7.9/' slope/site.toml
refused "is out of date, and shards only compute runs" SHARD=1 SHARDS=2 runs-shard
cp kept.toml slope/site.toml
made slope RUNS=6 WITHOUT=no prepare
prints "runs: 1 to make"

# contradictions
refused "runs-shard needs SHARDS" runs-shard
refused "SHARD goes with the goal runs-shard" SHARDS=2 runs-shard
refused "is 3/2, expected K/N" SHARD=3 SHARDS=2 runs-shard
refused "SHARD goes with the goal runs-shard" SHARD=1 SHARDS=2 maps
refused "submit needs SHARDS" submit
refused "submit stands alone" SHARDS=2 submit maps
made slope clean
nothing_left slope/out/shards slope/out/parts
