# A run from end to end: outputs, figures that must hold, equal bytes, XDMF, the plan.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs

expect 0 run_dda -o run.h5 --json
prints '"status": "done"'
prints '"n_blocks": 3'
prints '"n_crossings": 3'
prints '"n_frames": 81'
prints '"left_domain": 0'
nothing_left run.h5.part

# the same bytes again
expect 0 run_dda -o again.h5 -q
cmp run.h5 again.h5 || fail "two runs of the same inputs differ"
[ -z "$(cat out)$(cat err)" ] || fail "-q is not quiet"

# another seed of jitter is another run
expect 0 run_dda -o jitter.h5 -q --seed 2 --set solver.start_jitter_m_s=0.01
cmp -s run.h5 jitter.h5 && fail "jitter changes nothing"

# an existing output stays
expect 1 run_dda -o run.h5
says "exists already"
expect 0 run_dda -o run.h5 --overwrite -q --duration-s 1

# ParaView
expect 0 run_dda -o x.h5 --xdmf x.xmf -q --duration-s 1
[ "$(grep -c '<Time Value' x.xmf)" -eq 11 ] || fail "not one grid a frame in x.xmf"
grep -q 'x.xdmf.h5:/frame_10/points' x.xmf || fail "x.xmf does not name its data"
[ -s x.xdmf.h5 ] || fail "no data beside x.xmf"

# the plan: printed without a run, and as JSON
expect 0 run_dda --plan
prints "off  strains"
prints "on   crossings: 1 fence"
prints "off  base motion"
expect 0 run_dda --plan --json
prints '"item": "strains"'
expect 0 run_dda --plan=full -o full.h5 --json --duration-s 1
prints '"reason": "the full plan was asked for"'
expect 1 run_dda --plan=half -o half.h5
says "expected full or nothing"
expect 0 run_dda -o run2.h5 --passages-by centroid -q
cmp -s run2.h5 again.h5 && fail "passages by centroid change nothing"
exit 0
