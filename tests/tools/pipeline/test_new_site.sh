# A new site from an elevation model and a polygon, by one command; errors say what is missing.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
gdal_translate -q -ot Float64 -a_srs EPSG:32633 -a_ullr 499996 5200324 500228 5199996 \
  "$source_dir/sample_sites/designed/slope.asc" dem.tif
cat >source.geojson <<'END'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}},
 "features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon",
 "coordinates": [[[500092, 5200260], [500140, 5200260], [500140, 5200300], [500092, 5200300], [500092, 5200260]]]}}]}
END
new() { sh "$source_dir/pipelines/new_site.sh" "$@"; }
expect 0 new "a slope" dem.tif source.geojson "$source_dir/pipelines"
prints "a slope is made"
expect 0 make -C "a slope" BIN= blocks
[ -s "a slope/out/blocks.h5" ] || fail "no blocks"
expect 1 new "a slope" dem.tif source.geojson
says "a slope exists already"
expect 2 new other dem.tif
says "give a folder, the ground and the release polygon"
expect 1 new other absent.tif source.geojson
says "absent.tif: there is no such file"
expect 1 new other dem.tif dem.tif
says "dem.tif: not a vector file"
expect 0 new contours "$source_dir/sample_sites/designed/contours.gpkg" source.geojson "$source_dir/pipelines"
grep -q '^contours = ' contours/site.toml || fail "the contour map was not taken as one"
nothing_left other
