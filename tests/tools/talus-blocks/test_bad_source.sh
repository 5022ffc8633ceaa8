# Implausible sources: outside, over nodata, above ground, too small, crossing themselves.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
refused() {
  expect 1 blocks "$@"
  nothing_left blocks.h5
}
refused --set 'source.polygon=[[500012,5200012],[500134,5200012],[500034,5200034]]'
says "reaches outside the terrain at (500134, 5200012)"
refused --set 'source.polygon=[[500012.3,5200012.3],[500013.3,5200012.3],[500013,5200013]]'
says "no node of the terrain lies in the source area"
refused --set source.failure_surface=plane
says 'failure_surface = "plane" needs plane_dip_deg'
sed 's/polygon = .*/polygon_file = "nowhere.gpkg"/' site.toml >other.toml
expect 1 talus-blocks other.toml --trn trn.tif -o blocks.h5 --no-db
says "there is no such file"

awk 'NR == 16 { $12 = -9999 } { print }' slope.asc >hole.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 -a_nodata -9999 hole.asc hole.tif
talus-trn hole.tif -o holed.tif --no-db -q
expect 1 talus-blocks site.toml --trn holed.tif -o blocks.h5 --no-db
says "touches nodata at (5000"
nothing_left blocks.h5
