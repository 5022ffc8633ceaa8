# A run that fails its health gives a report that says so, and make ends with an error; what is wrong
# with a command still ends it.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
expect 2 make -C slope BIN= DDA_FLAGS='--set solver.max_penetration_m=1e-9' WITHOUT=no
says "run_1: talus-dda: health: largest penetration"
says "1 of 1 runs failed:"
grep -q "UNFINISHED OR FAILED" slope/out/report.html || fail "the report does not say that the run failed"
expect 2 make -C slope BIN= DDA_FLAGS=--no-such-option
