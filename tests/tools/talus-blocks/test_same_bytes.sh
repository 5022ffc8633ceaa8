# The same inputs, options and seed give the same bytes; another seed gives other blocks.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site '[joints.random]' 'dip_deg = 60' 'dip_direction_deg = 140' 'spacing_m = 6' \
  'spacing = "exponential"' 'fisher_k = 40' 'persistence = 0.7'
for run in a b; do
  expect 0 talus-blocks site.toml --trn trn.tif -o $run.h5 --no-db --footprints $run.gpkg --trn-out $run.tif
done
for kind in h5 gpkg tif; do cmp a.$kind b.$kind || fail "$kind differs between two runs"; done
expect 0 talus-blocks site.toml --trn trn.tif -o c.h5 --no-db --set source.seed=2
if cmp -s a.h5 c.h5; then fail "another seed gave the same blocks"; fi
