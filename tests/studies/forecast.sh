#!/bin/sh
# forecast.sh [OUT [FOLDER...]]: the share of the mass that talus-check forecasts beside the share that moves more
# than 1 m in a run, its time beside that of the run, for site folders (those of the shared slopes when none is
# given); then the root mean square of the differences. Results stay in OUT/NAME.
# BIN: folder of the executables with a slash at its end. Needs python3.
set -eu
cd "$(dirname "$0")/../.."
out=$(realpath -m "${1:-$(mktemp -d)}")
if [ $# -gt 1 ]; then
  shift
else
  [ -d ../shared/data ] || { echo "skipped: no ../shared/data"; exit 0; }
  set -- sample_sites/salisbury_crags sample_sites/gschnitz_gar sample_sites/lechtal_kotcliff sample_sites/lechtal_kotdam
fi
for folder; do
  name=$(basename "$folder")
  mkdir -p "$out"
  make -C "$folder" ${BIN:+BIN="$BIN"} OUT="$out/$name" RUNS=1 WITHOUT=no check runs runout >"$out/$name.log" 2>&1 || true
  [ -f "$out/$name/runout.json" ] || echo "$name: no result, see $out/$name.log"
done
python3 - "$out" "$@" <<'PY'
import json, os, sys
rows = []
for folder in sys.argv[2:]:
    name = os.path.basename(folder.rstrip('/'))
    try:
        check = json.load(open(f'{sys.argv[1]}/{name}/check.json'))
        runout = json.load(open(f'{sys.argv[1]}/{name}/runout.json'))
    except OSError:
        continue
    said, moved = check['probe']['moved_share'], runout['moved']['share_moved_1_m']
    kind = lambda share: 'stands' if share < .1 else 'goes' if share > .9 else 'goes in part'
    print(f'{name}: forecast {said:.2f}, moved {moved:.2f}; {kind(said)}, {kind(moved)}; peel-off {check["source"]["peel_off_share"]:.2f}; '
          f'{check["n_blocks"]} blocks, {check["expected_cpu_s"]:.0f} s expected')
    rows.append((said - moved, kind(said) == kind(moved)))
if rows:
    print(f'{len(rows)} sites: rms {(sum(d * d for d, _ in rows) / len(rows)) ** .5:.3f}, '
          f'worst {max(abs(d) for d, _ in rows):.2f}, class right in {sum(right for _, right in rows)}')
PY
