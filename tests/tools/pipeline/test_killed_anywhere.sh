# Kills at random moments, of all, of make, of one process: make again reaches the same bytes.
# TALUS_SEED=n repeats the choices of a run of this test, though not its moments.
. "$source_dir/tests/tools/pipeline/common.sh"
for program in setsid pgrep; do command -v $program >/dev/null || skip "needs $program"; done
seed=${TALUS_SEED:-$(date +%s)}
echo "TALUS_SEED=$seed"
state=$((seed % 2147483648))
# drawn BELOW: sets `drawn` to a number from 0 to BELOW - 1
drawn() {
  state=$(((state * 1103515245 + 12345) % 2147483648))
  drawn=$((state / 65536 % $1))
}
few='RUNS=3'
site whole
sed -i 's/^duration_s = .*/duration_s = 1/' whole/site.toml
begun=$(date +%s%3N)
made whole $few -j2
whole_ms=$(($(date +%s%3N) - begun))

site killed
cp whole/site.toml killed
n_killed=0 groups=
# Processes of a make that was killed continue beside the next one.
for _ in 1 2 3 4; do
  setsid make -C killed BIN= $few -j2 >log 2>&1 &
  group=$!
  drawn $((whole_ms / 2))
  sleep "$(printf '%d.%03d' $((drawn / 1000)) $((drawn % 1000)))"
  drawn 4
  case $drawn in
    0) victims=-$group signal=KILL ;;
    1) victims=$group signal=TERM ;;
    2) victims=$(pgrep -P "$(pgrep -d, -g $group talus-batch)" talus-dda 2>/dev/null || true) signal=KILL ;;
    3)
      all=$(pgrep -g $group || true)
      drawn 1000
      victims=$(echo $all | tr ' ' '\n' | sed -n "$((drawn % ($(echo $all | wc -w) + 1) + 1))p") signal=KILL
      ;;
  esac
  # shellcheck disable=SC2086  # a list of numbers
  [ -z "$victims" ] || { kill -s $signal -- $victims 2>/dev/null && n_killed=$((n_killed + 1)); } || true
  wait $group 2>/dev/null || true
  groups="$groups $group"
  # the last attempts have something to do, too
  drawn 4
  [ ! -s killed/out/report.html ] || rm -f "killed/out/runs/run_$((drawn % 3 + 1)).h5" "killed/out/trn.tif"
done
[ $n_killed -ge 1 ] || fail "only $n_killed attempts were killed"
made killed $few -j2
for group in $groups; do
  n=0
  while pgrep -g "$group" >/dev/null; do
    n=$((n + 1))
    [ $n -lt 600 ] || fail "processes of a make that is gone go on for a minute"
    sleep 0.1
  done
done
same whole killed

# and of a shard that makes a run and its part
for _ in 1 2; do
  rm -f killed/out/runs/run_1.h5
  setsid make -C killed BIN= $few SHARD=1 SHARDS=2 runs-shard >log 2>&1 &
  group=$!
  drawn $((whole_ms / 4))
  sleep "$(printf '%d.%03d' $((drawn / 1000)) $((drawn % 1000)))"
  kill -s KILL -- -$group 2>/dev/null || true
  wait $group 2>/dev/null || true
  made killed $few -j2
  same_results killed whole
done
expect 0 talus-runs --db killed/out/runs.sqlite list --summary
