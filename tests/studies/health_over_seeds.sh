#!/bin/sh
# health_over_seeds.sh ROCKS SITES SEED...: how many runs break a limit of their health, on the sites that
# single_rocks.sh left in ROCKS and real_sites.sh in SITES. A seed is that of the rocks' shapes and
# orientations, as the site has them, as slabs of 2 x 1.5 x 0.3 m and as rods of 3 x 0.4 x 0.4 m; of the
# masses' friction, scattered by 2 degrees, once about the site's angles and once about 18 degrees
# for rock and 20 for the ground, so that the masses go far and fast.
# BIN: folder of the executables with a slash at its end.
set -eu
[ $# -gt 2 ] || { sed -n '2,7s/^# //p' "$0"; exit 2; }
root=$(cd "$(dirname "$0")/../.." && pwd)
rocks=$(cd "$1" && pwd) sites=$(cd "$2" && pwd)
shift 2
bin=${BIN:-$root/build/release/tools/}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fast='--set joints.sliding.friction_deg=18 --set joints.rear.friction_deg=18 --set joints.lateral.friction_deg=18
      --set material.rock.friction_deg=18 --set ground.slope.friction_deg=20 --set solver.max_lost_share=1'
# run OPTION...: one run, a line where its health fails (talus-dda then ends with code 3)
run() {
  if "${bin}talus-dda" site.toml -o "$work/run.h5" --overwrite --no-db "$@" >"$work/log" 2>&1; then return; fi
  failed=$((failed + 1))
  grep -h 'health:\|error:' "$work/log" | sed "s/^talus-dda: /  seed $s: /"
}
for site in salisbury_crags gschnitz_gar lechtal_kotcliff lechtal_kotdam; do
  for kind in rocks slabs rods mass fast; do
    failed=0 extra=
    case $kind in
      slabs) extra='--set blocks.rock.size_m=[2,1.5,0.3]' ;;
      rods) extra='--set blocks.rock.size_m=[3,0.4,0.4]' ;;
      fast) extra=$fast ;;
    esac
    for s in "$@"; do
      # shellcheck disable=SC2086
      if [ $kind = rocks ] || [ $kind = slabs ] || [ $kind = rods ]; then
        cd "$rocks/$site"
        "${bin}talus-blocks" site.toml --set "blocks.rock.seed=$s" $extra --trn out/trn.tif -o "$work/blocks.h5" --overwrite --no-db -q
        run --seed 1 --trn out/bed.tif --blocks "$work/blocks.h5" --set solver.blocks=alone
      else
        cd "$root/sample_sites/$site"
        run --seed "$s" --trn "$sites/$site/bed.tif" --blocks "$sites/$site/blocks.h5" --set solver.friction_scatter_deg=2 $extra
      fi
    done
    echo "$site, $kind: $failed of $# runs break a limit of their health"
  done
done
