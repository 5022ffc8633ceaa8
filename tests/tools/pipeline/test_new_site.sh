# A new site from an elevation model and a polygon, by one command; errors name the missing part.
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
mkdir "my slopes"
expect 0 new "my slopes/a_slope" dem.tif source.geojson "$source_dir/pipelines"
prints "my slopes/a_slope is made"
prints "sliding (36 degrees towards 180): "
grep -q '^failure_surface = "daylighting"' "my slopes/a_slope/site.toml" || fail "the surface does not daylight"
grep -q '^layers = "site.gpkg"' "my slopes/a_slope/site.toml" || fail "the layers are not named"
ogrinfo -so "my slopes/a_slope/site.gpkg" source | grep -q 'Feature Count: 1' || fail "the source is not in its layer"
expect 0 make -C "my slopes/a_slope" BIN= blocks
prints "failure plane of set sliding: dips 36 degrees towards 180"
[ -s "my slopes/a_slope/out/blocks.h5" ] || fail "no blocks"
expect 1 new "my slopes/a_slope" dem.tif source.geojson
says "a_slope exists already"
expect 1 new absent/other dem.tif source.geojson
says "absent: there is no such folder"
expect 2 new other
says "give a folder and the ground"
expect 1 new other absent.tif source.geojson
says "absent.tif: there is no such file"
expect 1 new other dem.tif dem.tif
says "dem.tif: not a vector file"
expect 0 new contours "$source_dir/sample_sites/designed/contours.gpkg" source.geojson "$source_dir/pipelines"
grep -q '^contours = ' contours/site.toml || fail "the contour map was not taken as one"
expect 0 new undrawn dem.tif "" "$source_dir/pipelines"
says "there is no source yet: draw it in the layer source of site.gpkg"
ogrinfo -so undrawn/site.gpkg source | grep -q 'Feature Count: 0' || fail "a source from nowhere"
expect 0 make -C undrawn BIN= terrain
nothing_left other
[ -z "$(find . -name '.new-site*' -o -name .slope -o -name .joints)" ] || fail "parts of new-site are left"

# Where no plane can come out, where the slope cannot be measured, and without tools: said, and usable.
awk 'BEGIN { print "ncols 40\nnrows 40\nxllcenter 500000\nyllcenter 5200000\ncellsize 5\nNODATA_value -9999"
  for (r = 0; r < 40; r++) { for (c = 0; c < 40; c++) printf "%g ", 1.5 * (40 - r); print "" } }' >gentle.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 gentle.asc gentle.tif
sed 's/5200260/5200060/g; s/5200300/5200100/g' source.geojson >gentle.geojson
expect 0 new gentle gentle.tif gentle.geojson "$source_dir/pipelines"
says "WARNING: no failure surface of $work/gentle/site.toml daylights"
prints "the slope is no steeper than friction"
grep -q 'NO PLANE DAYLIGHTS here: the slope dips 17 degrees' gentle/site.toml || fail "the site file does not warn"
expect 0 make -C gentle BIN= blocks
sed 's/50009/50909/g; s/50014/50914/g' source.geojson >far.geojson
expect 0 new far dem.tif far.geojson "$source_dir/pipelines"
says "reaches outside the terrain"
says "the slope could not be measured, for the reason above"
grep -q 'THE SLOPE WAS NOT MEASURED' far/site.toml || fail "the site file does not warn"
expect 0 new built dem.tif source.geojson "$source_dir/pipelines" absent
says "the tools are not built"
grep -q 'THE SLOPE WAS NOT MEASURED' built/site.toml || fail "the site file does not warn"
grep -q '^polygon_file = "../source.geojson"' built/site.toml || fail "the source is not named"
expect 1 new built-2 dem.tif "" "$source_dir/pipelines" absent
says "give SOURCE"
nothing_left built-2

# pipelines in a folder whose path make would part or take for an order, also for a site made from there
mkdir 'My #1 Projects'
cp -r "$source_dir/pipelines" 'My #1 Projects/pipelines'
expect 0 new blank dem.tif source.geojson 'My #1 Projects/pipelines'
expect 0 make -C blank BIN= terrain
[ -s blank/out/trn.tif ] || fail "no terrain"
expect 0 make -C blank BIN= new-site NAME=beside DEM="$PWD/dem.tif" SOURCE="$PWD/source.geojson"
expect 0 make -C beside BIN= help

# by make: a name that make or the shell would part or run is refused before anything runs
site here
made here new-site NAME=there-2 DEM="$PWD/dem.tif" SOURCE="$PWD/source.geojson"
[ -s there-2/site.toml ] || fail "no site beside this one"
for name in "ns 2" "ns'2" 'ns"2' 'ns$$(touch hurt)' 'ns$(shell touch hurt)' 'ns`touch hurt`' 'ns;touch hurt'; do
  expect 2 make -C here BIN= new-site NAME="$name" DEM="$PWD/dem.tif" SOURCE="$PWD/source.geojson"
  says "expected letters (a to z), digits, _ and -"
  [ "$(echo *ns*)" = "*ns*" ] || fail "made for the name $name: $(echo *ns*)"
  nothing_left hurt here/hurt
done
