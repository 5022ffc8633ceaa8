# Jobs that make submit hands to Slurm, seen by stand-ins for its commands: the shards that lack
# runs, the variables that make was given, options word for word, the last job after the rest.
. "$source_dir/tests/tools/pipeline/common.sh"
mkdir stand_in
cat >stand_in/sbatch <<'END'
#!/bin/sh
n=$(cat "$SENT_TO/number" 2>/dev/null || echo 100)
n=$((n + 1))
echo $n >"$SENT_TO/number"
for word; do printf '%s\n' "$word"; done >"$SENT_TO/$n"
echo "$n;here"
END
cat >stand_in/squeue <<'END'
#!/bin/sh
[ ! -e "$SENT_TO/waiting" ] || echo 101
END
chmod +x stand_in/*
export SENT_TO="$PWD/stand_in"
PATH=$PWD/stand_in:$PATH
has() { grep -qxF -e "$2" "stand_in/$1" || { cat "stand_in/$1" >&2; fail "job $1 was not given $2"; }; }
# Runs the script of a job that was sent, as Slurm would.
carry_out() {
  sed -n '/^--wrap$/,$p' "stand_in/$1" | sed 1d >job.sh
  SLURM_ARRAY_TASK_ID=${2:-} SLURM_CPUS_PER_TASK=2 expect 0 sh job.sh
}
set -- RUNS=5 SHARDS=2 WITHOUT=no FINAL='maps runout' \
  DDA_FLAGS="--set site.description='a \$\$5 slope; or two'"
mkdir "a slope"
site "a slope"
variants "a slope" '[variant.low]\nweight = 1\nsolver.accuracy = 0.006\n[variant.as_it_is]\nweight = 1'

# the jobs that would be sent are listed, and none is sent
expect 0 make -C "a slope" BIN= -n "$@" SBATCH_FLAGS='-A acc -t 240' submit
prints "--array=1-2 "
prints " -A acc -t 240 "
prints "--kill-on-invalid-dep=yes"
[ ! -e stand_in/number ] || fail "make -n sent jobs"
[ ! -e "a slope/out" ] || fail "make -n wrote into out"

expect 0 make -C "a slope" BIN= "$@" SBATCH_FLAGS='-A acc --comment="two words"' SHARDS_AT_ONCE=7 submit
prints "job 101: shards 1-2 of 2"
prints "job 102: make maps runout, once these have ended well"
has 101 --array=1-2%7
has 101 --requeue
has 101 --open-mode=append
has 101 -A
has 101 "--comment=two words"
has 102 --dependency=afterok:101
has 102 --kill-on-invalid-dep=yes
has 102 "--comment=two words"

# while they wait nothing else makes the runs
touch stand_in/waiting
expect 2 make -C "a slope" BIN= "$@" submit
says "wait or run: 101 102"
rm stand_in/waiting

carry_out 101 2
[ "$(ls "a slope/out/runs/low" | tr '\n' ' ')" = "run_2.h5 run_4.h5 " ] || fail "shard 2 made $(ls "a slope/out/runs/low")"
talus-runs --db "a slope/out/shards/2-of-2.sqlite" list | grep -qF 'site.description=a $5 slope; or two' ||
  fail "a variable came another way to the job"

# missing runs
expect 0 make -C "a slope" BIN= "$@" submit
prints "job 103: shards 1 of 2"
has 103 --array=1
carry_out 103 1
carry_out 104
was_made_by "a slope" maps/reach.tif "talus-maps out/runs --trn"
expect 0 make -C "a slope" BIN= "$@" submit
prints "job 105: make maps runout"
if grep -q dependency stand_in/105; then fail "the last job waits for none"; fi
