# A run that is killed or interrupted leaves a readable file, and resumes to the same bytes.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
slow="--set solver.time_step_s=0.00005 --set output.checkpoint_interval_s=0.02 -q"

expect 0 run_dda -o whole.h5 $slow

# wait_for FILE: until it exists, while the run continues
wait_for() {
  n=0
  while [ ! -e "$1" ]; do
    n=$((n + 1))
    [ $n -lt 600 ] || fail "$1 did not appear"
    kill -0 $run_id 2>/dev/null || fail "the run ended before its first checkpoint"
    sleep 0.05
  done
}

# killed three times at different moments, with a half-written checkpoint lying about
for pause in 0 0.1 0.3; do
  rm -f killed.h5.part
  talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db --set solver.blocks=alone -o killed.h5 $slow &
  run_id=$!
  wait_for killed.h5.part
  sleep $pause
  kill -9 $run_id 2>/dev/null || fail "the run was over before it could be killed"
  wait $run_id 2>/dev/null || true
  [ ! -e killed.h5 ] || fail "a killed run left an output"
  [ -s killed.h5.part ] || fail "a killed run left nothing to go on from"
  printf 'half' >killed.h5.part.new
  expect 1 run_dda -o killed.h5 $slow
  says "a run that was stopped left behind"
  expect 0 run_dda -o killed.h5 $slow --resume
  cmp whole.h5 killed.h5 || fail "the resumed run differs from the whole one"
  rm -f killed.h5
  nothing_left killed.h5.part killed.h5.part.new
done

# interrupted, or its terminal closed: exit 130 after a checkpoint, here the first one
for signal in HUP TERM; do
  # one that has not come to its first step has nothing to keep: a busy machine gets longer
  for pause in 1 4 16; do
    rm -f stopped.h5.part
    talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db --set solver.blocks=alone -o stopped.h5 -q \
      --set solver.time_step_s=0.00005 --set output.checkpoint_interval_s=3600 &
    run_id=$!
    sleep $pause
    kill -$signal $run_id || fail "the run was over before SIG$signal"
    code=0
    wait $run_id || code=$?
    [ $code -eq 130 ] || fail "exit code $code after SIG$signal, expected 130"
    [ ! -s stopped.h5.part ] || break
  done
  [ -s stopped.h5.part ] || fail "no checkpoint after SIG$signal"
done

# only with the same settings
expect 1 run_dda -o stopped.h5 $slow --resume --set ground.ground.friction_deg=21
says "belongs to a run of other inputs or settings"
expect 1 talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db -o stopped.h5 $slow --resume
says "belongs to a run of other inputs or settings"  # blocks that touch each other are another run
cp stopped.h5.part other.h5.part
expect 0 run_dda -o other.h5 $slow --resume --overwrite --set ground.ground.friction_deg=21
expect 0 run_dda -o direct.h5 $slow --set ground.ground.friction_deg=21
cmp other.h5 direct.h5 || fail "--resume --overwrite went on from a run of other settings"
[ ! -e other.h5.part ] || fail "other.h5.part was left behind"
expect 0 run_dda -o stopped.h5 $slow --resume
cmp whole.h5 stopped.h5 || fail "the run resumed after SIGTERM differs from the whole one"

# damaged, or none
printf 'not HDF5' >broken.h5.part
expect 1 run_dda -o broken.h5 $slow --resume
says "broken.h5.part"
says "--overwrite starts again from the beginning"
expect 0 run_dda -o broken.h5 $slow --resume --overwrite
cmp whole.h5 broken.h5 || fail "a run that started again after a damaged checkpoint differs"
expect 0 run_dda -o fresh.h5 $slow --resume
cmp whole.h5 fresh.h5 || fail "--resume without a checkpoint is not a run from the start"
exit 0
