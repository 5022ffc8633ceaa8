# A run that fails its health gives a report that says so, and make ends with an error; a fault of
# a command still ends it.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v unzip >/dev/null || skip "needs unzip"
site slope
expect 2 make -C slope BIN= DDA_FLAGS='--set solver.max_penetration_m=1e-9' WITHOUT=no
says "run_1: error: health: largest penetration"
says "1 of 1 run failed:"
[ "$(grep -c '<p class="banner">[0-9 of]* runs* failed' slope/out/report.html)" -ge 8 ] || fail "the report does not say that the run failed"
grep -q '<b>1 of 1 run</b><span>did not move' slope/out/report.html || fail "nothing says that nothing moved"
unzip -p slope/out/site.qgz >project
grep -q '<title>designed: rockslide hazard (1 of 1 run failed its numerical checks)</title>' project || fail "the project is not marked"
[ "$(grep -c '<abstract>1 of 1 run failed its numerical checks$' project)" -gt 15 ] || fail "layers of the project are not marked"
# a fault of the command still ends it
expect 2 make -C slope BIN= DDA_FLAGS=--no-such-option
