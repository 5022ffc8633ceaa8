#!/bin/sh
# Builds everything and runs all tests but those of the label `long`. Installs what is missing.
#   sh tests/run.sh            the tests of every change
#   sh tests/run.sh long       the long studies (label long), built for release
set -eu
cd "$(dirname "$0")/.."
sh pipelines/install_packages.sh test

preset=dev tests=dev
if [ "${1:-}" = long ]; then preset=release tests=long; fi
export CCACHE_SLOPPINESS=pch_defines,time_macros  # lets ccache keep files that use a precompiled header
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset"
ctest --preset "$tests"
