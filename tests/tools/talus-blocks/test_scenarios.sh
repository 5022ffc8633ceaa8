# The four shared scenarios: convex blocks within 1 % of the mass.
[ -d "$shared_data" ] || skip "no ../shared/data"
for site in gschnitz_gar lechtal_kotcliff lechtal_kotdam salisbury_crags; do
  file=$source_dir/sample_sites/$site/site.toml
  dem=$(sed -n 's|^dem = ".*/dem/\(.*\)"|\1|p' "$file")
  expect 0 talus-trn "$shared_data/dem/$dem" -o $site.tif --no-db
  expect 0 talus-blocks "$file" --trn $site.tif -o $site.h5 --no-db --report $site.json
  change=$(sed -n 's/.*"convexified_change": \([-0-9.e+]*\).*/\1/p' $site.json)
  awk "BEGIN { exit !($change > -0.01 && $change < 0.01) }" || fail "$site: volume changed by $change"
done
