#!/bin/sh
# single_rocks.sh [OUT [SITE...]]: rockfall instead of a slide on the sample sites whose data stand beside
# the checkout: rocks of 0.3 m3 on a grid over the release polygon, a hundred to its area in plan, each as
# if alone, contours to maps and fence, and each site beside what its scenario expects. Results stay in
# OUT/SITE. A run that breaks a limit of its health is evaluated all the same, and the line says so.
# BIN: folder of the executables with a slash at its end. Needs python3-gdal and python3-numpy.
set -eu
cd "$(dirname "$0")/../.."
out=${1:-$(mktemp -d)}
[ $# -gt 1 ] && shift && sites=$* || sites='salisbury_crags gschnitz_gar lechtal_kotcliff lechtal_kotdam'
shared=$PWD/../shared
[ -d "$shared/data" ] || { echo "skipped: no ../shared/data"; exit 0; }
export BIN="${BIN:-$PWD/build/release/tools/}"
for site in $sites; do
  mkdir -p "$out/$site"
  area=$(ogrinfo -q -dialect sqlite -sql 'select st_area(geom) as area from release' "$shared/data/scenarios/$site.gpkg" |
    sed -n 's/.*area.*= //p')
  # the site without its rock mass, and with rocks instead
  awk -v shared="$shared" '
    /^\[/ { kept = !/^\[(joints|source)/ }
    kept && !/^(failure_surface|depth_m)/ { gsub(/\.\.\/\.\.\/\.\.\/shared/, shared); print }' \
    "sample_sites/$site/site.toml" >"$out/$site/site.toml"
  cat >>"$out/$site/site.toml" <<END

[rockfall.rock]
shape = "rock"
size_m = [1.2, 1.0, 0.8]
polygon_file = "$shared/data/scenarios/$site.gpkg|layername=release"
release_spacing_m = $(awk -v area="$area" 'BEGIN { printf "%.2f", sqrt(area / 100) }')
height_above_ground_m = 0.5

[solver]
duration_s = 80
max_lost_share = 1
END
  sed "s|\.\./\.\./\.\./shared|$shared|; s|\.\./\.\./pipelines|$PWD/pipelines|" "sample_sites/$site/Makefile" >"$out/$site/Makefile"
  evaluate() { make -k -C "$out/$site" OUT=out WITHOUT=no "$@"; }
  # a run that breaks a limit of its health keeps its file, and make takes it as made the second time
  evaluate runs >"$out/$site/log" 2>&1 || true
  evaluate maps runout fence >>"$out/$site/log" 2>&1 || [ -f "$out/$site/out/runout.json" ] || { tail "$out/$site/log" >&2; exit 1; }
  /usr/bin/python3 tests/studies/expected_path.py "$shared/data/scenarios/$site.json" "$out/$site/out"
done
