# A step that threads share has the bytes of one thread, also where a run resumes in another number
# of them; the tool says how fast it is and how long it will take.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain

# layers of 8 x 8 cubes in bond, a little apart, on the flat
layer() {  # NAME SHIFT_M HEIGHT_M
  printf '[blocks.%s]\nshape = "box"\nsize_m = [1, 1, 1]\nheight_above_ground_m = %s\nposition_m = [' $1 $3
  for x in 0 1 2 3 4 5 6 7; do
    for y in 0 1 2 3 4 5 6 7; do printf '[%s, %s], ' $((500120 + x)).$2 $((5000030 + y)).$2; done
  done
  printf ']\n'
}
{
  printf '[material.rock]\ndensity_kg_m3 = 2600\n[ground.ground]\nfriction_deg = 20\n'
  layer low 0 0.01
  layer middle 5 1.02
  layer high 25 2.03
  printf '[solver]\nduration_s = 0.6\nstart_jitter_m_s = 0.3\n'
} >site.toml
make_blocks
dda() { talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db "$@"; }

expect 0 dda -o one.h5 --json --threads 1
holds_number() { sed -n "s/.*\"$1\": \\([0-9.e+-]*\\),*/\\1/p" out; }
awk -v rate="$(holds_number simulated_s_per_cpu_s)" -v cpu="$(holds_number cpu_time_s)" \
  'BEGIN { exit !(cpu > 0 && rate * cpu > 0.599 && rate * cpu < 0.601) }' ||
  fail "simulated_s_per_cpu_s is not 0.6 s over cpu_time_s"
awk -v n="$(holds_number largest_speed_m_s)" 'BEGIN { exit !(n > 0.1) }' || fail "nothing moves"

for n in 2 3 8; do
  expect 0 dda -o shared.h5 --threads $n --overwrite
  grep -q "[0-9] s simulated per CPU second" out || fail "the summary does not say how fast it was"
  cmp one.h5 shared.h5 || fail "$n threads have other bytes than one"
done

# killed in two threads, it resumes in three and in one
for n in 3 1; do
  talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db -o killed.h5 --threads 2 \
    --set output.checkpoint_interval_s=0.02 -q &
  run_id=$!
  waited=0
  while [ ! -s killed.h5.part ]; do
    waited=$((waited + 1))
    [ $waited -lt 1200 ] || fail "killed.h5.part did not appear"
    kill -0 $run_id 2>/dev/null || fail "the run ended before its first checkpoint"
    sleep 0.05
  done
  kill -9 $run_id 2>/dev/null || fail "the run was over before it could be killed"
  wait $run_id 2>/dev/null || true
  [ ! -e killed.h5 ] || fail "a killed run left an output"
  expect 0 dda -o killed.h5 --threads $n --resume
  cmp one.h5 killed.h5 || fail "a run resumed in $n threads has other bytes"
  rm killed.h5
done

expect 2 dda -o none.h5 --threads -1
says "--threads"
nothing_left none.h5
