#!/bin/sh
# All faults against all tools.
#   sh tests/endurance/run.sh          the short form, as among the tests
#   sh tests/endurance/run.sh long     hundreds of kills, a registry of 100,000 runs, 1,000 fences and
#                                      5,000 objects, the release tools against those of preset dev
#                                      and of a build in another folder; leaves build/endurance.rows
#                                      (tests/studies/faults.py)
#   sh tests/endurance/run.sh long PART,...
#                                      of kill,signal,limit,memory,write,disk,names,sources,registry,many,same
set -eu
cd "$(dirname "$0")/../.."
build() {
  cmake --preset "$1" >/dev/null
  cmake --build --preset "$1" --target tools/all frame-probe
}
bins() { echo "$1/tools:$1/tests"; }
build dev
if [ "${1:-short}" = short ]; then
  exec python3 tests/endurance/endurance.py --bin "$(bins "$PWD/build/dev")" --source "$PWD" --work build/endurance
fi
build release

set -- --long --rows build/endurance.rows ${2:+--only "$2"}
case ",${5:-same}," in *,same,*)
  elsewhere=$PWD/build/elsewhere  # the same commit, cloned and built in another folder
  rm -rf "$elsewhere"
  git clone -q . "$elsewhere"
  (cd "$elsewhere" && build release)
  set -- "$@" --other "release and dev=$(bins "$PWD/build/dev")" \
    --other "a build in another folder=$(bins "$elsewhere/build/release")" ;;
esac
exec python3 -u tests/endurance/endurance.py --bin "$(bins "$PWD/build/release")" --source "$PWD" \
  --work build/endurance "$@"
