#!/bin/sh
# The main job on a sample site, from the contour map to the results. Installs missing packages,
# builds the tools, runs the site's pipeline, says where the results are.
#   sh pipelines/demo.sh [--packaged] [SITE]      SITE: a folder of sample_sites (maungawhau);
#   --packaged: with the tools of an installed Talus, nothing is built
set -eu
cd "$(dirname "$0")/.."
bin=$PWD/build/demo/tools/
if [ "${1:-}" = --packaged ]; then
  command -v talus >/dev/null ||
    { echo "demo.sh: there is no talus on the search path" >&2; exit 2; }
  bin=$(dirname "$(command -v talus)")/
  shift
fi
site=${1:-maungawhau}
[ -f "sample_sites/$site/Makefile" ] || {
  echo "demo.sh: there is no sample_sites/$site; there are: $(cd sample_sites && echo *)" >&2
  exit 2
}

if [ "$bin" = "$PWD/build/demo/tools/" ]; then
  sh pipelines/install_packages.sh build
  # lets ccache keep files that use a precompiled header
  export CCACHE_SLOPPINESS=pch_defines,time_macros
  cmake --preset release -DTALUS_TESTS=OFF -DTALUS_BENCH=OFF -B build/demo >/dev/null
  compiled=$(ls build/demo/tools/talus-report 2>/dev/null || true)
  [ -n "$compiled" ] || echo "Building the tools: 4 to 7 minutes on two cores, once." \
    "Then the site: a minute or two."
  cmake --build build/demo --target pipeline
fi
goals=all
# in this order neither has nothing to do
grep -q '^\[fence_search' "sample_sites/$site/site.toml" && goals='fence-search all'
code=0
# shellcheck disable=SC2086  # a list of words
make -j"$(nproc)" -C "sample_sites/$site" BIN="$bin" $goals || code=$?
out=sample_sites/$site/out
[ -f "$out/report.html" ] || exit "$code"
echo
echo "The results are in $out. Look at:"
echo "  $out/report.html   maps, fence verdicts, 3-D animation, health, what was assumed" \
  "(any browser)"
echo "  $out/site.qgz      the same as a QGIS project (QGIS 3.22 or later)"
echo "Your own slope: docs/guide/tutorial.md"
exit "$code"
