# Names of many runs go to the tools in lists: the same results, also where runs lack, and with fences.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v talus-reduce >/dev/null || skip "needs the tools of this checkout"
for folder in named listed; do site $folder; done
made named -j2 RUNS=4 maps runout fence
made listed -j2 RUNS=4 most_named=3 maps runout fence
[ "$(wc -l <listed/out/stages/runs.list.there)" = 4 ] || fail 'the list does not hold the runs'
[ "$(wc -l <listed/out/stages/without.list.in_parts)" = 4 ] || fail 'the list does not hold the runs without fences'
diff -r -q --exclude='runs.sqlite*' --exclude=.digests --exclude=.lock --exclude=made --exclude='*.list*' named/out listed/out || fail 'lists give other results'
made listed -j2 RUNS=4 most_named=3 maps runout fence
prints "Nothing to be done"

# one run lacks: it is not on the list, and counted
rm named/out/runs/run_3.h5 listed/out/runs/run_3.h5
for folder in named listed; do printf 'none\tdid not end by itself\n' >$folder/out/stages/failed/run_3; done
mkdir tools
for tool in "${bin%%:*}"/talus-*; do [ ! -f "$tool" ] || ln -s "$tool" tools; done
rm tools/talus-dda
printf '#!/bin/sh\nexit 1\n' >tools/talus-dda
chmod +x tools/talus-dda
for arguments in 'named' 'listed most_named=3'; do
  expect 2 make -C $arguments BIN="$PWD/tools/" RUNS=4 runout
  says '1 of 4 runs failed:'
done
[ "$(wc -l <listed/out/stages/runs.list.there)" = 3 ] || fail 'a run without result is on the list'
cmp named/out/runout.json listed/out/runout.json || fail 'lists give another run-out where a run lacks'
grep -q '"N_MISSING": "1"' listed/out/runout.json || fail 'the run that lacks is not counted'

# clean takes the lists away
made listed clean
[ ! -e listed/out ] || fail "clean left $(find listed/out)"
