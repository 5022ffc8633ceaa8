# make submit on a Slurm of three nodes: 12 seeds in 3 shards; the node of one dies on the way, another
# one reaches its time limit. Sent again, only missing runs are computed, and all outputs have the
# bytes of make -j2.
. "$source_dir/tests/tools/pipeline/common.sh"
. "$source_dir/tests/tools/pipeline/slurm.sh"
# Runs 4 (of shard 1) and 6 (of shard 3) stop on the way, at a checkpoint, while a folder `hold`
# exists.
mkdir tools hold
for tool in "${bin%%:*}"/talus-*; do [ ! -f "$tool" ] || ln -s "$tool" tools; done
rm tools/talus-dda
cat >tools/talus-dda <<END
#!/bin/sh
for seed in 4 6; do
  case " \$* " in *" --plan "*) ;; *" --seed \$seed "*) [ ! -d "$PWD/hold" ] || held=\$seed ;; esac
done
[ -n "\${held:-}" ] || exec "${bin%%:*}/talus-dda" "\$@"
"${bin%%:*}/talus-dda" "\$@" --set output.checkpoint_interval_s=0.02 &
process=\$!
until [ -s out/runs/run_\$held.h5.part ]; do sleep 0.02; done
kill -STOP \$process
echo \$process >"$PWD/hold/\$held"
wait \$process
END
chmod +x tools/talus-dda

few='RUNS=12 WITHOUT=no'
sent() {
  # shellcheck disable=SC2086  # words of make
  made slope $few SHARDS=3 FINAL=all BIN="$PWD/tools/" "$@" submit
}
wait_for() {
  what=$1
  shift
  n=0
  until "$@"; do
    n=$((n + 1))
    [ $n -lt 600 ] || { squeue >&2; tail -n 30 slope/out/shards/log/* >&2; fail "$what: not within two minutes"; }
    sleep 0.2
  done
}
all_over() { [ -z "$(squeue -h -o %i)" ]; }
state_of() { scontrol -o show job "$1" | sed 's/.*JobState=\([A-Z_]*\).*/\1/'; }
has_state() { [ "$(state_of "$1")" = "$2" ]; }
n_started() { talus-runs --db slope/out/runs.sqlite list | grep -c " --seed $1 "; }

site slope
sed -i 's/^duration_s = .*/duration_s = 6/' slope/site.toml
start_slurm
sent
prints "shards 1-3 of 3"
array=$(sed -n 's/^submit: job \([0-9]*\): shards.*/\1/p' out)
final=$(sed -n 's/^submit: job \([0-9]*\): make all.*/\1/p' out)
wait_for "runs 4 and 6 are on the way" test -s hold/4 -a -s hold/6

# nothing else makes the same runs meanwhile
expect 2 make -C slope BIN= $few runs
says "Jobs of Slurm for out wait or run: $array"

scontrol update JobId="${array}_1" EndTime="$(date -d '+2 seconds' +%Y-%m-%dT%H:%M:%S)"
kill_node "$(squeue -h -j "${array}_3" -o %N)"
rm -r hold
wait_for "the end of all jobs" all_over
has_state "${array}_1" TIMEOUT || fail "shard 1 is $(state_of "${array}_1")"
for shard in 2 3; do
  has_state "${array}_$shard" COMPLETED || fail "shard $shard is $(state_of "${array}_$shard")"
done
scontrol -o show job "${array}_3" | grep -q ' Restarts=1 ' || fail "shard 3 was not begun again elsewhere"
has_state "$final" CANCELLED || fail "the last job, which needs them all, is $(state_of "$final")"
[ -s slope/out/runs/run_4.h5.part ] || fail "run 4 left no checkpoint at the time limit"
[ ! -e slope/out/maps ] || fail "there are maps, and runs lack"
[ ! -e slope/out/parts/1-of-3.h5 ] || fail "the shard that lacks a run made a part"
for shard in 2 3; do
  [ -s slope/out/parts/$shard-of-3.h5 ] || fail "shard $shard made no part"
done

# missing runs
sent -n
prints "--array=1 "
sent
prints "shards 1 of 3"
wait_for "the end of all jobs" all_over
grep -q "run_4: goes on at" slope/out/shards/log/*_1.txt || fail "run 4 began again at its beginning"
grep -q "run_6: goes on at" slope/out/shards/log/*_3.txt || fail "run 6 began again at its beginning"
[ -s slope/out/maps/reach.tif ] || { cat slope/out/shards/log/final_* >&2; fail "no maps"; }

# one registry, each run in it once, but for the two that were ended
for seed in 1 2 3 5 7 8 9 10 11 12; do
  [ "$(n_started $seed)" -eq 1 ] || fail "run $seed was computed $(n_started $seed) times"
done
for seed in 4 6; do
  [ "$(n_started $seed)" -eq 2 ] || fail "run $seed stands $(n_started $seed) times in the registry"
done
expect 0 talus-runs trace slope/out/maps/reach.tif
prints "--seed 12 "
was_made_by slope maps/reach.tif "talus-maps out/runs --trn"

# the same by one make
site whole
cp slope/site.toml whole
# shellcheck disable=SC2086  # words of make
made whole $few -j2
same_results slope whole
# shellcheck disable=SC2086  # words of make
made slope $few
prints "Nothing to be done for 'all'"
stop_slurm
