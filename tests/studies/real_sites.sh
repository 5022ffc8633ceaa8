#!/bin/sh
# real_sites.sh [RUNS [OUT [SITE...]]]: the sample sites whose data stand beside the checkout, as slides of
# touching blocks: contours to maps and fence, RUNS seeds with friction scattered by 2 degrees, joints set
# coarser so that a site has some 60 blocks, or with SPACING=own as its site file has them, 259 to 888
# blocks; with SOIL=meadow (or another soil) the ground gives way so, with the friction of the site files.
# Then each beside what its scenario expects. Results stay in OUT/SITE. A run that breaks a limit
# of its health is evaluated all the same, and the line says so.
# BIN: folder of the executables with a slash at its end. Needs python3-gdal and python3-numpy.
set -eu
cd "$(dirname "$0")/../.."
runs=${1:-2} out=${2:-$(mktemp -d)}
[ $# -gt 2 ] && shift 2 && sites=$* || sites='salisbury_crags gschnitz_gar lechtal_kotcliff lechtal_kotdam'
mkdir -p "$out"
scenarios=../shared/data/scenarios
[ -d "$scenarios" ] || { echo "skipped: no ../shared/data"; exit 0; }
# coarse SITE: spacings of the sliding joints, and of the others
coarse() {
  [ "${SPACING:-coarse}" = own ] && return
  case $1 in
    salisbury_crags) set -- 6 8 ;;
    gschnitz_gar) set -- 12 14 ;;
    lechtal_kotcliff) set -- 10 12 ;;
    lechtal_kotdam) set -- 10 14 ;;
  esac
  echo "--set joints.sliding.spacing_m=$1 --set joints.rear.spacing_m=$2 --set joints.lateral.spacing_m=$2"
}
ground=${SOIL:+--set ground.slope.soil=$SOIL}
for site in $sites; do
  make -k -C "sample_sites/$site" ${BIN:+BIN="$BIN"} OUT="$out/$site" RUNS="$runs" WITHOUT=no BLOCKS_FLAGS="$(coarse "$site")" \
    DDA_FLAGS="--set solver.friction_scatter_deg=2 $ground" runs >"$out/$site.log" 2>&1 || true
  # a failed run keeps its file: make takes it as made the second time
  make -C "sample_sites/$site" ${BIN:+BIN="$BIN"} OUT="$out/$site" RUNS="$runs" WITHOUT=no BLOCKS_FLAGS="$(coarse "$site")" \
    DDA_FLAGS="--set solver.friction_scatter_deg=2 $ground" maps runout fence >>"$out/$site.log" 2>&1 ||
    [ -f "$out/$site/runout.json" ]  # make ends with an error where runs failed
  /usr/bin/python3 tests/studies/expected_path.py "$scenarios/$site.json" "$out/$site"
done
