# Contours -> Delaunay -> nodes of the true DEM: the errors that another implementation (scipy)
# found for linear interpolation on five real maps, to the digits that it gave.
[ -d "$shared_data/contours" ] || skip "there is no ../shared/data beside the checkout"
while read -r contours dem covered rmse largest; do
  expect 0 talus-tin "$shared_data/contours/$contours.gpkg" -o $contours.ply --flat keep --no-db
  expect 0 talus-trn $contours.ply -o $contours.tif --like "$shared_data/dem/$dem.tif" \
    --reference "$shared_data/dem/$dem.tif" --report $contours.json --no-db
  awk -F: -v covered="$covered" -v rmse="$rmse" -v largest="$largest" '
    function off(a, b, half) { return a - b > half || b - a > half }
    /"reference"/ { inside = 1 }
    inside && /"covered_share"/ && off($2 * 100, covered, 0.051) { print "covers " $2; bad = 1 }
    inside && /"rmse_m"/ && off($2 + 0, rmse, 0.0051) { print "RMSE " $2; bad = 1 }
    inside && /"largest_m"/ && off($2 + 0 < 0 ? -$2 : $2 + 0, largest, largest > 10 ? 0.051 : 0.0051) { print "largest " $2; bad = 1 }
    END { exit bad }' $contours.json || fail "$contours: differs from the baseline"
done <<'END'
salisbury_crags_5m salisbury_crags_dsm_2m5 100 1.06 4.98
gschnitz_gar_10m gschnitz_gar_5m 96.7 0.69 8.48
gschnitz_gar_20m gschnitz_gar_5m 92.7 1.56 18.5
lechtal_kotcliff_5m lechtal_kotcliff_5m 75.7 0.82 4.12
lechtal_kotdam_10m lechtal_kotdam_5m 98.5 1.13 8.71
END
