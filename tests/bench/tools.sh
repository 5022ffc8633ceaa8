#!/bin/bash
# CPU seconds and memory of the tools, as their pages state them: each row is run three times, the
# registry's figures are printed (median CPU seconds of user and system, largest memory).
#   bash tests/bench/tools.sh [BIN] [WORK]     BIN: folder of the executables (release), WORK: kept
# Rows of sites whose data are beside the checkout (../shared/data) are left out where these are missing.
set -euo pipefail
cd "$(dirname "$0")/../.."
source_dir=$PWD data=$PWD/../shared/data
bin=$(cd "${1:-build/release/tools}" && pwd)
work=${2:-$(mktemp -d)}
mkdir -p "$work"
export GDAL_NUM_THREADS=1 LC_ALL=C

# row NAME TOOL ARGUMENTS...: run TOOL three times
row() {
  local name=$1 tool=$2 i
  shift 2
  for i in 1 2 3; do
    rm -f "$work/row.sqlite"
    "$bin/$tool" "$@" --overwrite -q --db "$work/row.sqlite" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
    "$bin/talus-runs" --db "$work/row.sqlite" show 1 | awk '$1 == "cost" { print $2, $(NF - 1) }'
  done | sort -n | awk -v name="$tool, $name" '
    { cpu[NR] = $1; if ($2 > mib) mib = $2 }
    END { printf "%-58s %8.2f CPU s %6.0f MB\n", name, cpu[2], mib * 1.048576 }'
}

# site NAME ARGUMENTS...: terrain, blocks, runs, run-out, maps and fence of a sample site, each as a row
site() {
  local name=$1 folder=$source_dir/sample_sites/$1 out=$work/$1 run
  shift
  make -s -C "$folder" BIN="$bin/" OUT="$out" "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
  run=$(ls "$out"/runs/run_*.h5 | head -n 1)
  row "$name: blocks" talus-blocks "$folder/site.toml" --trn "$out/trn.tif" -o "$work/b.h5" --trn-out "$work/bed.tif"
  row "$name: a run" talus-dda "$folder/site.toml" --trn "$out/bed.tif" --blocks "$out/blocks.h5" -o "$work/r.h5"
  row "$name: $(basename "$run"), $(stat -c %s "$run") bytes" talus-runout "$run" --trn "$out/bed.tif" -o "$work/r.gpkg"
  row "$name: the same" talus-fence "$folder/site.toml" "$run" --trn "$out/bed.tif" -o "$work/f.gpkg"
  row "$name: the same" talus-maps "$run" --trn "$out/bed.tif" -o "$work/maps"
}
site designed
site maungawhau

# a million points of contours, nine million nodes
gdalwarp -q -overwrite -r cubicspline -ts 1740 1220 -ot Float32 \
  sample_sites/maungawhau/volcano.asc "$work/fine.tif"
rm -f "$work/fine.gpkg"
gdal_contour -q -3d -a ELEV -i 0.34 "$work/fine.tif" "$work/fine.gpkg"
row "maungawhau every 0.34 m, --flat keep" talus-tin "$work/fine.gpkg" --crs none -o "$work/keep.ply" --flat keep
row "maungawhau every 0.34 m, --flat fill" talus-tin "$work/fine.gpkg" --crs none -o "$work/fill.ply"
row "that TIN (keep) to cells of 0.242 m" talus-trn "$work/keep.ply" -o "$work/t.tif" --cell-size-m 0.242
row "the nine million nodes, copied" talus-trn "$work/t.tif" -o "$work/copy.tif"
row "the same, averaged to cells of 2 m" talus-trn "$work/t.tif" -o "$work/mean.tif" --cell-size-m 2

[ -d "$data" ] || exit 0
for map in gschnitz_gar_10m salisbury_crags_5m su42_os_terrain50_contours; do
  [ -f "$data/contours/$map.gpkg" ] || continue
  field=$(ogrinfo -so -al "$data/contours/$map.gpkg" | sed -n 's/^\(ELEV\|PROP_VALUE\): .*/\1/p' | head -n 1)
  for flat in keep fill; do
    row "$map, --flat $flat" talus-tin "$data/contours/$map.gpkg" -o "$work/t.ply" --flat $flat --elevation-field "$field"
  done
done
folder=$source_dir/sample_sites/gschnitz_gar
make -s -C "$folder" BIN="$bin/" OUT="$work/gschnitz_gar" terrain >"$work/log" 2>&1
for spacing in 6 3 1.5 0.8; do
  for exact in "" --exact; do
    row "gschnitz_gar, joints every $spacing m $exact" talus-blocks "$folder/site.toml" --trn "$work/gschnitz_gar/trn.tif" \
      -o "$work/b.h5" --trn-out "$work/bed.tif" --report "$work/b.json" $exact --set joints.sliding.spacing_m=$spacing \
      --set joints.rear.spacing_m=$spacing --set joints.lateral.spacing_m=$spacing --set source.max_blocks=1000000
    sed -n 's/.*"n_blocks": \([0-9]*\).*/  \1 blocks/p' "$work/b.json"
  done
done
