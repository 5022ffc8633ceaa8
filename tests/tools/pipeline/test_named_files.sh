# Files that options name, and those that belong to a Shapefile beside it, are inputs like any.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
site slope
cat >source.geojson <<'END'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}},
 "features": [{"type": "Feature", "properties": {"id": 1}, "geometry": {"type": "Polygon",
 "coordinates": [[[500092, 5200252], [500140, 5200252], [500140, 5200300], [500092, 5200300], [500092, 5200252]]]}}]}
END
ogr2ogr -f "ESRI Shapefile" -a_srs EPSG:32633 "slope/the source.shp" source.geojson
rm -f "slope/the source.cpg"
sed -i 's/^polygon = .*/polygon_file = "the source.shp"/' slope/site.toml
gdal_translate -q -ot Float64 -a_srs EPSG:32633 -a_ullr 499996 5200324 500228 5199996 \
  "$source_dir/sample_sites/designed/slope.asc" slope/dem.tif
cp "$source_dir/share/codes/onr_24810.csv" slope/code.csv
cp "$source_dir/share/mobility.csv" slope/mobility.csv

would() {
  made slope -n "$@"
  tools=$(sed -n 's/^talus-\([a-z]*\) .*/\1/p' out | sort -u | tr '\n' ' ')
}
would_be() { [ "$tools" = "$1" ] || fail "$2: make would start: $tools, expected $1"; }

set -- TRN_FLAGS='--reference=dem.tif' FENCE_FLAGS='--code code.csv' RUNOUT_FLAGS='--mobility mobility.csv'
made slope -j2 "$@"
would "$@"
would_be "" "nothing changed"
echo "# a remark" >>slope/mobility.csv
would "$@"
would_be "report runout " "another table of mobility"
echo "# a remark" >>slope/code.csv
would "$@"
would_be "fence report runout " "another design code"
gdal_translate -q -co COMPRESS=DEFLATE slope/dem.tif dem.tif && cp dem.tif slope/dem.tif
would "$@"
would_be "batch blocks check fence maps report runout trn " "another reference"
made slope -j2 "$@"

touch "slope/the source.dbf"
would "$@"
would_be "" "the same attributes"
ogr2ogr -f "ESRI Shapefile" -a_srs EPSG:32633 -sql 'SELECT 2 AS id FROM source' other.shp source.geojson
cp other.dbf "slope/the source.dbf"
would "$@"
would_be "batch blocks check fence import maps report runout " "other attributes of the source"
made slope -j2 "$@"
printf ISO-8859-1 >"slope/the source.cpg"
would "$@"
would_be "batch blocks check fence import maps report runout " "an encoding that came later"
made slope -j2 "$@"
rm "slope/the source.cpg"
would "$@"
would_be "batch blocks check fence import maps report runout " "no encoding any more"

# a file that a setting names with the quotes of TOML, and one with its layer
sed -i 's/^line = .*/file = "first.geojson"/' slope/site.toml
cat >slope/line.geojson <<'END'
{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[500060,5200150],[500164,5200150]]}}]}
END
cp slope/line.geojson slope/first.geojson
set -- DDA_FLAGS="--set 'fence.valley.file=\"line.geojson\"'" TRN_FLAGS="--reference-points 'points.gpkg|layername=points'"
printf 'x,y,z\n500100,5200200,50\n500120,5200220,55\n500140,5200100,9\n' >points.csv
ogr2ogr -q -f GPKG -a_srs EPSG:32633 -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z slope/points.gpkg points.csv
made slope runs "$@"
would runs "$@"
would_be "" "nothing changed"
sed -i 's/5200150/5200151/g' slope/line.geojson
would runs "$@"
would_be "batch " "another line named by a setting"
sed -i 's/5200151/5200150/g' slope/line.geojson
sed -i 's/,55$/,56/' points.csv
ogr2ogr -q -f GPKG -overwrite -a_srs EPSG:32633 -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z slope/points.gpkg points.csv
would runs "$@"
would_be "batch blocks check trn " "other points of a layer that an option names"
