# The first tiles: who failed, who did not move, how much of the mass did; extremes with their count.
mkdir all half
run-probe all 3 still_runs=1
run-probe half 1 seed=5 status=failed blocks=3 still=2 moving=1
# report_of FOLDER: of the files in it, as talus-runout and talus-maps say it
report_of() {
  mkdir -p "$1/out/runs"
  cp "$1/slope.tif" "$1/out/trn.tif"
  for run in "$1"/run_*.h5; do cp "$run" "$1/out/runs/"; done
  expect 0 talus-runout "$1"/out/runs/run_*.h5 --trn "$1/out/trn.tif" -o "$1/out/runout.gpkg" --json "$1/out/runout.json" --no-db
  expect 0 talus-report "$1/site.toml" --dir "$1/out" -o "$1/out/report.html" --qgis "$1/out/site.qgz" --no-db --json
}
# holds FOLDER TEXT
holds() { grep -qF -- "$2" "$1/out/report.html" || fail "the report of $1 does not say: $2"; }

report_of all
holds all '<b>1 of 3 runs</b><span>did not move: no block by more than 1 m.'
holds all '<b>66.7 %</b><span>of the released mass moved more than 1 m, 66.7 % more than 20 m.'
holds all 'farthest block along its path, largest of the 2 runs that moved'
holds all 'atan(H/L), smallest of the 2 runs that moved'
holds all 'in plan, mean of the 2 runs that moved'
holds all 'Over the 2 of 3 runs that are events'
grep -q 'class="banner"' all/out/report.html && fail 'a mark where no run failed'

report_of half
prints '"reason": "a limit was broken; ended at 5 of 8 s"'
says '1 of 1 run failed its numerical checks: run_0 (a limit was broken'
holds half '<b>1 of 1 run</b><span>failed its numerical checks'
holds half '<b>33.3 %</b><span>of the released mass moved more than 1 m'
holds half 'Less than half of the released mass moved.'
holds half 'along its path, of one run; it was still moving at the end of 1 run'
holds half '<td>a limit was broken; ended at 5 of 8 s</td>'
n_sections=$(grep -c '<section ' half/out/report.html)
[ "$(grep -c '^<section .*</h2>$' half/out/report.html)" = "$n_sections" ] || fail 'sections were not counted'
[ "$(grep -c '^<p class="banner">1 of 1 run failed its numerical checks</p>$' half/out/report.html)" = "$n_sections" ] || fail 'a section is not marked'
[ "$n_sections" -ge 7 ] || fail "only $n_sections sections"
