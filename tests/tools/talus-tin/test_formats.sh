# The same map gives the same triangles from every format, and the tool says where the height is from.
. "$source_dir/tests/tools/talus-tin/map.sh"
cone >map.geojson
expect 0 talus-tin map.geojson -o geojson.ply --report geojson.json
says "elevation from Z of layer map"
[ "$(value geojson.json n_points)" = 100 ] || fail "$(value geojson.json n_points) points read, expected 4 rings of 25"
ogr2ogr -q map.gpkg map.geojson
ogr2ogr -q -lco SHPT=ARCZ map.shp map.geojson
ogr2ogr -q -f GML -dsco FORMAT=GML3 map.gml map.geojson
ogr2ogr -q -nlt MULTILINESTRINGZ -nln many multi.gpkg map.geojson
ogr2ogr -q -f DXF map.dxf map.gpkg -dialect sqlite -sql "SELECT geom FROM map"
for file in map.gpkg map.shp map.gml multi.gpkg; do
  expect 0 talus-tin "$file" -o "$file.ply"
  says "elevation from Z"
  data geojson.ply >expected
  data "$file.ply" >found
  cmp -s expected found || fail "$file gives other triangles than map.geojson"
done
expect 0 talus-tin map.dxf -o dxf.ply --crs EPSG:32632 --report dxf.json
[ "$(value dxf.json n_triangles)" = "$(value geojson.json n_triangles)" ] || fail "DXF gives other triangles"

# a layer of a drawing is chosen by its name
ogr2ogr -q -f DXF layers.dxf map.gpkg -dialect sqlite \
  -sql "SELECT geom, CASE WHEN ELEV > 110 THEN 'HIGH' ELSE 'LOW' END AS Layer FROM map"
expect 0 talus-tin 'layers.dxf|layername=HIGH' -o high.ply --crs EPSG:32632 --report high.json
[ "$(value high.json n_lines) $(value high.json lowest_m)" = "2 120.0" ] ||
  fail "layer HIGH gives $(value high.json n_lines) lines from $(value high.json lowest_m) m"
expect 1 talus-tin 'layers.dxf|layername=NONE' -o no.ply --crs EPSG:32632
says "the drawing has nothing in a layer \"NONE\""

# 2-D: the height is in a field, found by its name or named by the user, as number or text
ogr2ogr -q -dim XY flat.shp map.geojson
expect 0 talus-tin flat.shp -o shp2d.ply
says "elevation from field ELEV"
data shp2d.ply >found
cmp -s expected found || fail "a 2-D shapefile with ELEV gives other triangles"
ogr2ogr -q -dim XY -sql "SELECT CAST(ELEV AS CHARACTER(10)) AS words, NAME FROM map" text.gpkg map.geojson
expect 1 talus-tin text.gpkg -o no.ply
says "no field has a known name"
expect 0 talus-tin text.gpkg -o text.ply --elevation-field words
says "elevation from field words"
data text.ply >found
cmp -s expected found || fail "heights written as text give other triangles"

# Z of all zeros is not an elevation where a field tells heights apart
ogr2ogr -q -dim XY zero2d.gpkg map.geojson
ogr2ogr -q -dim XYZ zero.gpkg zero2d.gpkg
expect 0 talus-tin zero.gpkg -o zero.ply
says "elevation from field ELEV"

# the CRS is in the header, and each format keeps it
for file in map.gpkg.ply map.shp.ply dxf.ply; do
  sed '/^end_header$/q' "$file" | grep -a '^comment crs' | grep -qa 'UTM zone 32N' || fail "$file has no CRS"
done
nothing_left no.ply
