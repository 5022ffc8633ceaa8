# Runs in shards: together they are the runs of `make runs`, with one registry; a shard makes nothing
# that others read, brings its runs together in a part, and what it was given to do last is done.
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

# what a shard needs is made before, by one make
refused "a shard makes runs alone: make prepare" SHARD=1 SHARDS=2 runs-shard
made slope $few prepare
prints "5 runs to make"
[ -s slope/out/blocks.h5 ] || fail "prepare made no blocks"
[ -z "$(ls slope/out/runs)" ] || fail "prepare made runs"

# with so many runs that others read them from lists, a shard still looks at its own alone
shard 1 most_named=3 SHARD_LAST='ls out/runs >last_step.txt'
[ "$(tr '\n' ' ' <slope/last_step.txt)" = "run_1.h5 run_3.h5 run_5.h5 " ] || fail "the last step saw $(cat slope/last_step.txt)"
prints "runs: 3 done, 0 failed, 0 to go"
prints "3 runs, "
[ -s slope/out/parts/1-of-2.h5 ] || fail "shard 1 made no part"
shard 1
if grep -q " passages in " out; then fail "a part that stands was made again"; fi
made slope $few prepare
prints "2 runs to make"
shard 2
[ ! -e slope/out/shards/merged ] || fail "a shard merged registries"
made slope $few prepare
prints "0 runs to make"
made slope $few -j2 maps runout
prints "7 runs added"
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
was_made_by slope maps/reach.tif "talus-maps out/parts/1-of-2.h5 out/parts/2-of-2.h5 --trn"
was_made_by slope runout.gpkg "talus-runout out/runs/run_1.h5 "

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
rm slope/out/maps/reach.tif slope/out/shards/merged
echo 'no registry at all' >slope/out/shards/1-of-2.sqlite
made slope $few maps
says "the logs of the shards are not merged"
[ -s slope/out/maps/reach.tif ] || fail "no map for the sake of logs"
rm slope/out/shards/*.sqlite

# a part that was made of other runs than are wanted does not count, nor one of runs that were made again
made slope RUNS=4 WITHOUT=no maps
was_made_by slope maps/reach.tif "talus-maps out/parts/2-of-2.h5 out/runs/run_1.h5 out/runs/run_3.h5 --trn"
touch slope/out/runs/run_2.h5
made slope RUNS=4 WITHOUT=no maps
was_made_by slope maps/reach.tif "talus-maps out/runs/run_1.h5 out/runs/run_2.h5 out/runs/run_3.h5 out/runs/run_4.h5 --trn"

# another site file: not made by a shard; another seed range: only what lacks
cp slope/site.toml kept.toml
sed -i 's/^spacing_m = 7.8/spacing_m = 7.9/' slope/site.toml
refused "is to be made again, and a shard makes runs alone" SHARD=1 SHARDS=2 runs-shard
cp kept.toml slope/site.toml
made slope RUNS=6 WITHOUT=no prepare
prints "6 runs to make"

# a run that fails its health does not end a shard; one that was killed does
mkdir tools
for tool in "${bin%%:*}"/talus-*; do [ ! -f "$tool" ] || ln -s "$tool" tools; done
rm tools/talus-dda
cat >tools/talus-dda <<'END'
#!/bin/sh
last=
for word; do [ "$last" != --failures ] || mark=$word; last=$word; done
case " $* " in
  *" --seed 1 "*) talus-dda "$@" && printf 'kept\tlargest penetration\n' >"$mark"; exit 3 ;;
  *" --seed 2 "*) kill -9 $$ ;;
esac
exec talus-dda "$@"
END
chmod +x tools/talus-dda
expect 0 make -C slope BIN="$PWD/tools/" $few SHARD=1 SHARDS=2 runs-shard
prints "2 done, 1 failed, 0 to go"
expect 2 make -C slope BIN="$PWD/tools/" $few SHARD=2 SHARDS=2 SHARD_LAST='touch not_done' runs-shard
says "run_2: did not end by itself"
[ ! -e slope/not_done ] || fail "the last step of a shard that lacks a run was done"
# Sent again, the shard makes that run alone; nothing is lost of what failed.
rm slope/out/runs/run_4.h5
expect 2 make -C slope BIN="$PWD/tools/" $few SHARD=2 SHARDS=2 runs-shard
prints "1 done, 1 failed, 0 to go"
sed -i 's/ kill -9 \$\$ / : /' tools/talus-dda
expect 0 make -C slope BIN="$PWD/tools/" $few SHARD=2 SHARDS=2 runs-shard
prints "1 done, 0 failed, 0 to go"
prints "2 runs, "
ends_with_failed() {
  folder=$1
  shift
  # shellcheck disable=SC2086
  expect 2 make -C "$folder" BIN="$PWD/tools/" $few "$@" maps runout
  says "1 of 5 runs failed:"
  says "run_1: largest penetration"
}
ends_with_failed slope
was_made_by slope maps/reach.tif "talus-maps out/parts/1-of-2.h5 out/parts/2-of-2.h5 --trn"
rm whole/out/runs/run_1.h5
ends_with_failed whole -j2
same_results slope whole

# A reduction that was killed, before and after it wrote: half a part counts for nothing, all has the same bytes.
rm tools/talus-reduce
cat >tools/talus-reduce <<'END'
#!/bin/sh
[ ! -e before ] || kill -9 $$
talus-reduce "$@"
[ ! -e after ] || kill -9 $PPID
END
chmod +x tools/talus-reduce
for moment in before after; do
  touch "slope/$moment" slope/out/runs/run_2.h5
  expect 2 make -C slope BIN="$PWD/tools/" $few SHARD=2 SHARDS=2 runs-shard
  rm "slope/$moment"
  ends_with_failed slope
  was_made_by slope maps/reach.tif "talus-maps out/parts/1-of-2.h5 out/runs/run_2.h5 out/runs/run_4.h5 --trn"
  same_results slope whole
done
expect 0 make -C slope BIN="$PWD/tools/" $few SHARD=2 SHARDS=2 runs-shard
prints "2 runs, "
truncate -s -1 slope/out/parts/1-of-2.h5
touch slope/out/runs/run_1.h5
ends_with_failed slope
was_made_by slope maps/reach.tif "talus-maps out/parts/2-of-2.h5 out/runs/run_1.h5 out/runs/run_3.h5 out/runs/run_5.h5 --trn"
same_results slope whole

# without parts
touch slope/out/runs/run_1.h5
ends_with_failed slope REDUCE=no
was_made_by slope maps/reach.tif "talus-maps out/runs/run_1.h5 out/runs/run_2.h5 "
same_results slope whole
rm -r slope/out/parts
expect 0 make -C slope BIN="$PWD/tools/" $few SHARD=1 SHARDS=2 REDUCE=no runs-shard
[ ! -e slope/out/parts ] || fail "REDUCE=no made a part"
refused "REDUCE is 'perhaps', expected yes or no" REDUCE=perhaps maps

# what cannot be meant
refused "runs-shard needs SHARD and SHARDS" runs-shard
refused "SHARD is '0', expected a whole number, 1 or more" SHARD=0 SHARDS=2 runs-shard
refused "SHARD is 3, expected a number up to SHARDS: 2" SHARD=3 SHARDS=2 runs-shard
refused "SHARD goes with the goal runs-shard" SHARD=1 SHARDS=2 maps
refused "submit needs SHARDS" submit
refused "submit stands alone" SHARDS=2 submit maps
made slope clean
nothing_left slope/out/shards slope/out/parts
