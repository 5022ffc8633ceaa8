# Parts made at the same time are together the runs of one batch, and results of both have the same bytes.
. "$source_dir/tests/tools/talus-batch/common.sh"
batch --runs 5 --part 1/2 2>first &
expect 0 batch --runs 5 --part 2/2
wait || fail "$(cat first)"
for part in 1 2; do [ -s results/parts/$part-of-2.h5 ] || fail "no part $part"; done
[ ! -e results/runs/ensemble.json ] || fail "a part wrote the ensemble of all"
made_again 0 --runs 5
grep -q '"../parts/1-of-2.h5"' results/runs/ensemble.json || fail "the ensemble names no parts"
expect 0 talus-maps results/runs --trn results/bed.tif -o of_parts --no-db
rm -r results/parts
expect 0 talus-maps results/runs --trn results/bed.tif -o of_runs --no-db
for map in of_runs/*.tif; do cmp "$map" "of_parts/${map#of_runs/}" || fail "$map depends on parts"; done

# a part that holds a run that is not wanted does not count, nor half of one
expect 0 batch --runs 5 --part 1/2
expect 0 batch --runs 5 --part 2/2
made_again 0 --runs 4
if grep -q '1-of-2' results/runs/ensemble.json; then fail "a part with run 5 counts"; fi
grep -q '2-of-2' results/runs/ensemble.json || fail "a part of wanted runs does not count"
truncate -s -9 results/parts/2-of-2.h5
expect 0 talus-maps results/runs --trn results/bed.tif -o of_runs --overwrite --no-db || fail "half a part"
expect 0 batch --runs 5 --part 2/2

# one that was cut off makes no part, and says so; the rest is not touched
rm results/runs/run_2.h5 results/parts/2-of-2.h5
stand_in talus-dda <<'END'
case " $* " in *" --plan "*) ;; *" --seed 2 "*) kill -9 $$ ;; esac
END
expect 1 batch --launcher "$PWD/tools/" --runs 5 --part 2/2
says "run_2: did not end by itself"
[ ! -e results/parts/2-of-2.h5 ] || fail "a part without one of its runs"
expect 0 batch --runs 5 --status --part 0/2
[ "$(cat out)" = "stale 1 2 6 5" ] || fail "status: $(cat out)"
