#!/bin/sh
# make_contours.sh: the contour map of this site from R's grid `volcano` (README.md says how it was
# placed). Needs gdal-bin. The result stands in the repository; this shows where it came from.
set -eu
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# volcano.asc lists the grid with west-east and north-south exchanged (a mirror image of the hill):
# turn it about its diagonal, then place it.
awk 'NR <= 6 { next } { n_cols = NF; for (c = 1; c <= NF; ++c) z[NR - 6, c] = $c; n_rows = NR - 6 }
  END {
    printf "ncols %d\nnrows %d\nxllcorner 1756959\nyllcorner 5917008\ncellsize 10\n", n_rows, n_cols
    for (r = 1; r <= n_cols; ++r) { for (c = 1; c <= n_rows; ++c) printf "%s ", z[c, r]; print "" }
  }' volcano.asc >"$work/placed.asc"
gdal_translate -q -a_srs EPSG:2193 "$work/placed.asc" "$work/placed.tif"
rm -f contours.gpkg
gdal_contour -q -3d -a elevation_m -i 5 "$work/placed.tif" "$work/contours.gpkg" -f GPKG -nln contours
# A fixed date makes the file the same bytes every time.
OGR_CURRENT_DATE=2026-01-01T00:00:00.000Z ogr2ogr -q -f GPKG contours.gpkg "$work/contours.gpkg"
