# A run that fails its health ends make; where what evaluates it may take it, make goes on to a report
# that says so.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v unzip >/dev/null || skip "needs unzip"
site slope
code=0
make -C slope BIN= DDA_FLAGS='--set solver.max_penetration_m=1e-9' WITHOUT=no >out 2>err || code=$?
[ $code -eq 2 ] || fail "make ended with $code after a run that failed its health"
says "health: largest penetration"
nothing_left slope/out/runout.json
rm -r slope/out
made slope DDA_FLAGS='--set solver.max_penetration_m=1e-9' EVALUATE_FLAGS=--allow-unfinished
[ "$(grep -c '<p class="banner">[0-9 of]* runs* failed' slope/out/report.html)" -ge 8 ] || fail "the report does not say that the run failed"
grep -q '<b>1 of 1 run</b><span>did not move' slope/out/report.html || fail "nothing says that nothing moved"
unzip -p slope/out/site.qgz >project
grep -q '<title>designed: rockslide hazard (1 of 1 run failed its numerical checks)</title>' project || fail "the project is not marked"
[ "$(grep -c '<abstract>1 of 1 run failed its numerical checks</abstract>' project)" -gt 15 ] || fail "layers of the project are not marked"
# what is wrong with the command still ends it
code=0
make -C slope BIN= DDA_FLAGS=--no-such-option EVALUATE_FLAGS=--allow-unfinished >out 2>err || code=$?
[ $code -eq 2 ] || fail "make ended with $code for an option that talus-dda does not have"
