# A run that fails stops no other; the outcome of each is said, and tried again where it may help.
. "$source_dir/tests/tools/talus-batch/common.sh"
stand_in talus-dda <<'END'
case " $* " in
  *" --plan "*) ;;
  *" --seed 2 "*) kill -9 $$ ;;
  *" --seed 3 "*) set -- "$@" --set base_motion.file=absent.csv ;;
  *" --seed 4 "*) [ ! -e lost ] || exit 0 ;;
esac
END
: >lost
failing() { expect 3 batch --launcher "$PWD/tools/" --jobs 2 "$@"; }
failing --runs 5
says "3 of 5 runs failed:"
says "run_2: did not end by itself: it was killed by signal 9"
says "absent.csv"
says "run_4: did not end by itself: what starts it lost it"
[ "$(outcomes)" = "done,no result,no result,no result,done" ] || fail "outcomes: $(outcomes)"
expect 0 talus-maps results/runs --trn results/bed.tif -o maps --no-db
gdalinfo maps/reach.tif | grep -q 'REMARK=3 of 5 runs missing' || fail "the maps do not say that runs are missing"
rm lost
failing --runs 5
says "2 of 5 runs failed:"
made_again 2 --runs 5
[ "$(outcomes)" = done,done,done,done,done ] || fail "outcomes: $(outcomes)"

# a broken limit: the result stays, and is not made again
expect 3 batch --runs 2 -- --set solver.duration_s=2 --set solver.max_penetration_m=1e-9
says "2 of 2 runs failed:"
says "run_1: largest penetration"
[ "$(outcomes)" = "failed its checks,failed its checks" ] || fail "outcomes: $(outcomes)"
touch mark
expect 3 batch --runs 2 -- --set solver.duration_s=2 --set solver.max_penetration_m=1e-9
[ -z "$(find results/runs -name '*.h5' -newer mark)" ] || fail "a run that failed its checks was made again"
expect 3 batch --runs 2 --status -- --set solver.duration_s=2 --set solver.max_penetration_m=1e-9
says "2 of 2 runs failed:"

# none has a result, or the site cannot be used
rm -r results/runs
expect 1 batch --launcher "$PWD/tools/" --runs 1 --seed 2
says "no run has a result"
expect 1 batch --runs 1 -- --no-such-option
says "--no-such-option"
