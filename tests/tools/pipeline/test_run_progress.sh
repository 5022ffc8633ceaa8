# Make says how far the runs are: it counts those that it has to make, not those that are there.
. "$source_dir/tests/tools/pipeline/common.sh"
said() { sed -n 's/, about .* left$//; s/^runs: //p' out | tr '\n' ';'; }
site slope
set -- WITHOUT=no CASES='a b'
made slope RUNS=2 "$@" runs
[ "$(said)" = "1 done, 0 failed, 3 to go;2 done, 0 failed, 2 to go;3 done, 0 failed, 1 to go;4 done, 0 failed, 0 to go;" ] || fail "said: $(said)"
grep -q '^runs: .*, about [0-9]* s left$' out || fail "nothing on the time left: $(cat out)"
nothing_left slope/out/stages/.progress

# one more seed, other options of one case, a result that is gone
rm slope/out/runs/run_a_1.h5
made slope RUNS=3 "$@" CASE_b='--set ground.slope.friction_deg=24' -j2 runs
[ "$(said | tr ';' '\n' | tail -n 1)" = "5 done, 0 failed, 0 to go" ] || fail "said: $(said)"
[ "$(said | tr ';' '\n' | wc -l)" -eq 5 ] || fail "said: $(said)"
nothing_left slope/out/stages/.progress

# those that fail are counted apart; -s says nothing
expect 2 make -C slope BIN= RUNS=2 "$@" CASE_b='--set solver.max_penetration_m=1e-9' runs
[ "$(said)" = "0 done, 1 failed, 1 to go;0 done, 2 failed, 0 to go;" ] || fail "said: $(said)"
made slope -s RUNS=2 SEED=7 "$@" runs
[ -z "$(said)" ] || fail "with -s make says $(said)"
nothing_left slope/out/stages/.progress

# what the goals need: maps no runs without the fence, a file itself
made slope maps RUNS=2
[ "$(said)" = "1 done, 0 failed, 1 to go;2 done, 0 failed, 0 to go;" ] || fail "said: $(said)"
made slope out/without/run_2.h5 RUNS=2
[ "$(said)" = "1 done, 0 failed, 0 to go;" ] || fail "said: $(said)"
made slope runs RUNS=2
[ "$(said)" = "1 done, 0 failed, 0 to go;" ] || fail "said: $(said)"
nothing_left slope/out/stages/.progress
