#!/bin/sh
# How wrong is a terrain made from contours? Plain triangles beside mended ones, against the true
# elevation model, as Markdown tables: the five derived sites, the genuine map (no truth: flat shares
# only), and further contour maps made here from other elevation models.
#   sh tests/studies/terrain_error.sh [BIN]      BIN: folder of the executables
set -eu
cd "$(dirname "$0")/../.."
bin=$(cd "${1:-build/release/tools}" && pwd)
data=$(cd ../shared/data 2>/dev/null && pwd) || {
  echo "terrain_error.sh: the elevation models stand in ../shared/data, which is not there" >&2
  exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

value() { sed -n "s/^ *\"$2\": *\([^,]*\),\{0,1\}$/\1/p" "$1" | head -1; }

# tin NAME CONTOURS MODE: triangles and their report
tin() { "$bin/talus-tin" "$2" -o "$work/$1.$3.ply" --flat "$3" --report "$work/$1.$3.json" --no-db -q; }

# row NAME CONTOURS DEM: one line of the table
row() {
  for mode in keep fill; do
    tin "$1" "$2" "$mode" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
    "$bin/talus-trn" "$work/$1.$mode.ply" -o "$work/$1.$mode.tif" --like "$3" --reference "$3" \
      --report "$work/$1.$mode.trn.json" --no-db -q 2>/dev/null
  done
  printf '%s %s %s %s %s %s %s %s %s\n' "$1" "$(value "$work/$1.keep.json" n_points)" \
    "$(value "$work/$1.fill.json" share_before)" "$(value "$work/$1.fill.json" share_after)" \
    "$(sed -n '/"reference"/,$p' "$work/$1.fill.trn.json" | sed -n 's/.*"covered_share": \([0-9.]*\).*/\1/p' | head -1)" \
    "$(value "$work/$1.keep.trn.json" rmse_m)" "$(value "$work/$1.fill.trn.json" rmse_m)" \
    "$(value "$work/$1.keep.trn.json" largest_m)" "$(value "$work/$1.fill.trn.json" largest_m)" |
    awk '{ gsub("_", " ", $1)
           printf "| %s | %d | %.1f -> %.1f %% | %.1f %% | %.3f | %.3f | %+.1f %% | %.2f | %.2f |\n",
             $1, $2, 100 * $3, 100 * $4, 100 * $5, $6, $7, 100 * ($7 / $6 - 1), $8, $9 }'
}
header() {
  echo "| Map | Points | Flat area, before -> after | Covered | RMSE plain, m | RMSE mended, m | Change | Largest plain, m | Largest mended, m |"
  echo "|---|---|---|---|---|---|---|---|---|"
}

header
row salisbury_crags_5_m "$data/contours/salisbury_crags_5m.gpkg" "$data/dem/salisbury_crags_dsm_2m5.tif"
row gschnitz_gar_10_m "$data/contours/gschnitz_gar_10m.gpkg" "$data/dem/gschnitz_gar_5m.tif"
row gschnitz_gar_20_m "$data/contours/gschnitz_gar_20m.gpkg" "$data/dem/gschnitz_gar_5m.tif"
row lechtal_kotcliff_5_m "$data/contours/lechtal_kotcliff_5m.gpkg" "$data/dem/lechtal_kotcliff_5m.tif"
row lechtal_kotdam_10_m "$data/contours/lechtal_kotdam_10m.gpkg" "$data/dem/lechtal_kotdam_5m.tif"
tin su42 "$data/contours/su42_os_terrain50_contours.gpkg" fill 2>/dev/null
awk -v n="$(value "$work/su42.fill.json" n_points)" -v a="$(value "$work/su42.fill.json" share_before)" \
  -v b="$(value "$work/su42.fill.json" share_after)" \
  'BEGIN { printf "| su42 10 m (genuine) | %d | %.1f -> %.1f %% | | | | | | |\n", n, 100 * a, 100 * b }'

echo
echo "Further maps, contoured here with gdal_contour:"
echo
header
# made NAME DEM INTERVAL
made() {
  GDAL_PAM_ENABLED=NO gdal_contour -q -3d -a ELEV -i "$3" "$data/dem/$2" "$work/$1.gpkg"
  row "$1" "$work/$1.gpkg" "$data/dem/$2"
}
made holyrood_park_10_m holyrood_park_dsm_2m5.tif 10
made serles_20_m serles_10m.tif 20
made serles_50_m serles_10m.tif 50
made arlberg_20_m arlberg_wog_full_5m.tif 20
made lechtal_10_m lechtal_kot_full_5m.tif 10
made lechtal_20_m lechtal_kot_full_5m.tif 20
made gschnitz_full_10_m gschnitz_gar_full_5m.tif 10
made gschnitz_full_20_m gschnitz_gar_full_5m.tif 20
made maungawhau_5_m maungawhau_lidar_5m.tif 5
made maungawhau_10_m maungawhau_lidar_5m.tif 10
made sainte_helens_50_m SainteHelens.dem 50
