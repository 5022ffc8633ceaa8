#!/bin/bash
# Contours of a million vertices to nine million nodes: talus-tin and talus-trn beside gdal_grid's
# linear interpolation of the same points on the same nodes, in one run, in CPU seconds of one
# thread. The map is the sample site's grid, resampled smoothly.
#   bash tests/bench/terrain_vs_gdal_grid.sh [BIN] [WORK]     BIN: folder of the tools
set -eu
cd "$(dirname "$0")/../.."
bin=${1:-$PWD/build/release/tools}
work=${2:-$(mktemp -d)}
mkdir -p "$work"
volcano=$PWD/sample_sites/maungawhau/volcano.asc
cd "$work"
export GDAL_NUM_THREADS=1 LC_ALL=C

cpu() { # cpu NAME COMMAND...: prints a line and keeps the seconds in $seconds
  local name=$1 TIMEFORMAT='%U %S'
  shift
  seconds=$({ time "$@" >/dev/null 2>log; } 2>&1 | awk '{ print $1 + $2 }')
  [ ! -s log ] || grep -i error log || true
  printf '%-42s %8.2f CPU s\n' "$name" "$seconds"
}

rm -f fine.tif contours.gpkg mended.ply tin.ply trn.tif grid.tif
gdalwarp -q -r cubicspline -ts 1740 1220 -ot Float32 -s_srs EPSG:2193 -t_srs EPSG:2193 "$volcano" fine.tif
gdal_contour -q -3d -a ELEV -i 0.34 fine.tif contours.gpkg
cpu "talus-tin (contours -> mended TIN)" "$bin/talus-tin" contours.gpkg -o mended.ply --no-db
mended=$seconds
cpu "talus-tin --flat keep (contours -> TIN)" "$bin/talus-tin" contours.gpkg -o tin.ply --flat keep --no-db
tin=$seconds
cpu "talus-trn (TIN -> 9 million nodes)" "$bin/talus-trn" tin.ply -o trn.tif --cell-size-m 0.242 --no-db
trn=$seconds
sed '/^end_header/q' tin.ply | grep -a '^element'
read -r cols rows < <(gdalinfo trn.tif | sed -n 's/^Size is \([0-9]*\), \([0-9]*\)/\1 \2/p')
read -r west north < <(gdalinfo trn.tif | sed -n 's/^Upper Left *( *\([0-9.-]*\), *\([0-9.-]*\)).*/\1 \2/p')
read -r east south < <(gdalinfo trn.tif | sed -n 's/^Lower Right *( *\([0-9.-]*\), *\([0-9.-]*\)).*/\1 \2/p')
echo "$cols x $rows nodes"
cpu "gdal_grid -a linear (points -> nodes)" gdal_grid -q -a linear:radius=0:nodata=-9999 -zfield ELEV \
  -txe "$west" "$east" -tye "$north" "$south" -outsize "$cols" "$rows" -ot Float64 -of GTiff \
  -co COMPRESS=DEFLATE -co PREDICTOR=3 -co ZLEVEL=1 -co TILED=YES contours.gpkg grid.tif
awk -v a="$tin" -v b="$trn" -v c="$seconds" \
  'BEGIN { printf "gdal_grid / (talus-tin --flat keep + talus-trn) = %.1f\n", c / (a + b) }'
awk -v a="$mended" -v b="$trn" -v c="$seconds" \
  'BEGIN { printf "gdal_grid / (talus-tin + talus-trn) = %.1f\n", c / (a + b) }'
