#!/bin/sh
# make_contours.sh: the contour map of this site from slope.asc. Needs gdal-bin and awk.
# The grid gets one more row and column around, carried on in a straight line, so that the contours
# reach beyond its outermost nodes; then contours every metre.
set -eu
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

awk '
  NR <= 6 { next }
  { n_rows++; n_cols = NF; for (c = 1; c <= NF; c++) z[n_rows, c] = $c }
  END {
    for (r = 1; r <= n_rows; r++) {
      z[r, 0] = 2 * z[r, 1] - z[r, 2]
      z[r, n_cols + 1] = 2 * z[r, n_cols] - z[r, n_cols - 1]
    }
    for (c = 0; c <= n_cols + 1; c++) {
      z[0, c] = 2 * z[1, c] - z[2, c]
      z[n_rows + 1, c] = 2 * z[n_rows, c] - z[n_rows - 1, c]
    }
    printf "ncols %d\nnrows %d\nxllcenter 499992\nyllcenter 5199992\ncellsize 8\n", n_cols + 2, n_rows + 2
    for (r = 0; r <= n_rows + 1; r++)
      for (c = 0; c <= n_cols + 1; c++) printf "%.6f%s", z[r, c], c <= n_cols ? " " : "\n"
  }' slope.asc >"$work/padded.asc"
gdal_translate -q -ot Float64 -a_srs EPSG:32633 "$work/padded.asc" "$work/padded.tif"
OGR_CURRENT_DATE=2026-01-01T00:00:00.000Z \
  gdal_contour -q -i 1 -a elevation_m -nln contours -f GPKG "$work/padded.tif" "$work/contours.gpkg"
mv "$work/contours.gpkg" contours.gpkg
