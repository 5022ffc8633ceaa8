# A run that fails stops no other: the rest is made, make lists failed runs and why, and ends
# with an error; made again it computes nothing that would fail the same.
. "$source_dir/tests/tools/pipeline/common.sh"
# failing ARGUMENTS...: make makes all that it can and ends with an error
failing() { expect 2 make -C slope BIN= WITHOUT=no "$@"; }
n_runs() { grep -c '"run_id"' slope/out/runout.json; }
site slope

# one case breaks a limit: its result is there and used
variants slope '[variant.good]\nweight = 1\n[variant.bad]\nweight = 1\nsolver.max_penetration_m = 1e-9'
set -- -j2 RUNS=2
failing "$@"
says "2 of 4 runs failed:"
says "  bad/run_1: largest penetration, m is"
says "  bad/run_2: largest penetration, m is"
says "take a smaller time_step_s"
prints "good/run_2: "
says "bad/run_2: error: health: largest penetration"
for name in runs/bad/run_1.h5 runs/good/run_2.h5 report.html site.qgz maps/velocity.tif; do
  [ -s "slope/out/$name" ] || fail "no $name"
done
failing "$@" V=1
says "  bad/run_1: largest penetration, m is"
if grep -q '^talus-' out; then fail "a run that failed was computed again, or evaluated: $(grep '^talus-' out)"; fi
variants slope ""
made slope -j2 RUNS=2 WITHOUT=no
rm -r slope/out

# one is killed, another one dies of an input: their places are said to be empty
mkdir tools
for tool in "${bin%%:*}"/talus-*; do [ ! -f "$tool" ] || ln -s "$tool" tools; done
rm tools/talus-dda
cat >tools/talus-dda <<'END'
#!/bin/sh
case " $* " in
  *" --plan "*) ;;
  *" --seed 2 "*) kill -9 $$ ;;
  *" --seed 3 "*) set -- "$@" --set base_motion.file=absent.csv ;;
esac
exec talus-dda "$@"
END
chmod +x tools/talus-dda
broken() { expect 2 make -C slope BIN="$PWD/tools/" WITHOUT=no "$@"; }
broken -j2 RUNS=4
says "2 of 4 runs failed:"
says "  run_2: did not end by itself: it was killed by signal 9, or the machine was out of memory (no result)"
says "  run_3: "
[ ! -e slope/out/runs/run_2.h5 ] && [ ! -e slope/out/runs/run_3.h5 ] || fail "a run without result has a file"
grep -q '"REMARK": "2 of 4 runs missing"' slope/out/runout.json || fail "the run-out does not say that runs are missing"
grep -q 'Runs missing: 2\.</b>' slope/out/report.html || fail "the report does not say that runs are missing"
made slope -j2 WITHOUT=no RUNS=4
if grep -q 'N_MISSING' slope/out/runout.json; then fail "runs are missing that are there"; fi

# files of an earlier make are not taken for the run that was killed
sed -i 's/^friction_deg = 25/friction_deg = 26/' slope/site.toml
broken RUNS=2 maps runout
says "1 of 2 runs failed:"
grep -q '"REMARK": "1 of 2 runs missing"' slope/out/runout.json || fail "a run of an earlier site file was evaluated"
[ -s slope/out/maps/velocity.tif ] || fail "no maps"

# none has a result
rm -r slope/out
failing DDA_FLAGS=--no-such-option
says "The following argument was not expected: --no-such-option"
nothing_left slope/out/runout.json
