#!/bin/sh
# All faults against all tools, and the table of docs/verification.md.
#   sh tests/endurance/run.sh          the short form, as among the tests
#   sh tests/endurance/run.sh long     hundreds of kills, 10,000 registered runs, presets dev and
#                                      release against each other; writes the table with the commit
#   sh tests/endurance/run.sh long PART,...   of kill,signal,limit,memory,disk,names,sources,registry,same
set -eu
cd "$(dirname "$0")/../.."
build() {
  cmake --preset "$1" >/dev/null
  cmake --build --preset "$1" --target tools/all frame-probe
}
bins() { echo "$PWD/build/$1/tools:$PWD/build/$1/tests"; }
build dev
if [ "${1:-short}" = short ]; then
  exec python3 tests/endurance/endurance.py --bin "$(bins dev)" --source "$PWD" --work build/endurance
fi
build release
result=0
python3 -u tests/endurance/endurance.py --bin "$(bins release)" --other-bin "$(bins dev)" --source "$PWD" \
  --work build/endurance --long --rows build/endurance.rows ${2:+--only "$2"} || result=1
python3 tests/endurance/write_table.py build/endurance.rows docs/verification.md
exit $result
