# Coordinates in another system are reprojected with a note; a terrain in degrees is refused.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
expect 0 blocks --report here.json
cat >area.csv <<'CSV'
id,wkt
1,"POLYGON ((500012 5200012, 500034 5200012, 500034 5200034, 500012 5200034, 500012 5200012))"
CSV
ogr2ogr -q -f GPKG area.gpkg area.csv -oo GEOM_POSSIBLE_NAMES=wkt -a_srs EPSG:32633 -nlt POLYGON
ogr2ogr -q -f GPKG degrees.gpkg area.gpkg -t_srs EPSG:4326
sed 's/^polygon = .*/polygon_file = "degrees.gpkg"/' site.toml >degrees.toml
expect 0 talus-blocks degrees.toml --trn trn.tif -o there.h5 --no-db --report there.json
says "degrees.gpkg: layer area, 1 polygon of 484 m2 in all; reprojected from EPSG:4326"
a=$(value here.json prism_volume_m3) b=$(value there.json prism_volume_m3)
holds "($a / $b - 1) ^ 2 < 0.01"

# a GeoPackage without CRS calls it undefined: it is taken to be the terrain's
cp area.gpkg undefined.gpkg
for table in gpkg_geometry_columns gpkg_contents; do
  ogrinfo -q undefined.gpkg -sql "UPDATE $table SET srs_id = 0" >/dev/null
done
sed 's/^polygon = .*/polygon_file = "undefined.gpkg"/' site.toml >undefined.toml
expect 0 talus-blocks undefined.toml --trn trn.tif -o undefined.h5 --no-db --report undefined.json
[ "$(value undefined.json prism_volume_m3)" = "$a" ] || fail "another volume without a CRS"
# a GeoJSON without crs means degrees for any values
printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[500012,5200012],[500034,5200012],[500034,5200034],[500012,5200012]]]}}]}' >metres.geojson
sed 's/^polygon = .*/polygon_file = "metres.geojson"/' site.toml >metres.toml
expect 1 talus-blocks metres.toml --trn trn.tif -o metres.h5 --no-db
says "but the coordinates are not degrees"
says "hint: name the CRS in the file: ogr2ogr -a_srs EPSG:code named.gpkg metres.geojson"
nothing_left metres.h5

sed 's/EPSG:32633/EPSG:32632/' site.toml >other.toml
expect 1 talus-blocks other.toml --trn trn.tif -o other.h5 --no-db
says "reaches outside the terrain"

sed 's/EPSG:32633/EPGS:32633/' site.toml >misspelt.toml
expect 1 talus-blocks misspelt.toml --trn trn.tif -o misspelt.h5 --no-db
says "misspelt.toml:$(grep -n '^crs' site.toml | cut -d: -f1): crs: \"EPGS:32633\" is not a CRS"
says "hint: write EPSG:code"
nothing_left misspelt.h5
