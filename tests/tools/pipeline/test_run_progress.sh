# Make says how far the runs are: it counts those that it has to make, not those that are there.
. "$source_dir/tests/tools/pipeline/common.sh"
said() { sed -n 's/, about .* left$//; s/^runs: //p' err | tr '\n' ';'; }
site slope
both='[variant.a]\nweight = 1\n[variant.b]\nweight = 1'
variants slope "$both"
set -- WITHOUT=no
made slope RUNS=2 "$@" runs
[ "$(said)" = "1 done, 0 failed, 3 to go;2 done, 0 failed, 2 to go;3 done, 0 failed, 1 to go;4 done, 0 failed, 0 to go;" ] || fail "said: $(said)"
grep -q '^runs: .*, about [0-9]* s left$' err || fail "nothing on the time left: $(cat err)"

# one more seed, other options of one case, a result that is gone; those that fail are counted apart
rm slope/out/runs/a/run_1.h5
variants slope "$both\nsolver.max_penetration_m = 1e-9"
expect 2 make -C slope BIN= RUNS=3 "$@" -j2 runs
[ "$(said | tr ';' '\n' | tail -n 1)" = "2 done, 3 failed, 0 to go" ] || fail "said: $(said)"
[ "$(said | tr ';' '\n' | wc -l)" -eq 5 ] || fail "said: $(said)"

variants slope ""
# runs that the goals need: maps no runs without the fence
made slope maps RUNS=1
[ "$(said)" = "1 done, 0 failed, 0 to go;" ] || fail "said: $(said)"
[ ! -e slope/out/without ] || fail "maps made runs without the fence"
made slope runs RUNS=1
[ "$(said)" = "1 done, 0 failed, 0 to go;" ] || fail "said: $(said)"
