# Boxes that friction holds have moved nowhere: their extent is no run-out, and it is said.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
sed -e 's/^height_above_ground_m.*//' -e 's/^spin_rad_s.*//' -e 's/^velocity_m_s.*//' site.toml >flat.toml
mv flat.toml site.toml
make_blocks
for friction in 80 10; do
  expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o "run_$friction.h5" --no-db \
    --duration-s 2 --set "$(grep -o 'ground\.[a-z]*' site.toml | head -1).friction_deg=$friction"
done
expect 0 talus-runout run_80.h5 --trn slope.tif -o held.gpkg --no-db
says 'a mass that stands, no run-out'
expect 0 talus-runout run_10.h5 --trn slope.tif -o gone.gpkg --no-db
grep -q 'a mass that stands' err && fail 'boxes that slid are said to stand'
exit 0
