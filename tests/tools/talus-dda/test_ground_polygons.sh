# Polygons of a ground section are united, and the result names their layer; surfaces are not areas.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
polygon='{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[500000,5000000],[500150,5000000],[500150,5000100],[500000,5000100],[500000,5000000]]]}}'
inner='{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[500005,5000020],[500145,5000020],[500145,5000080],[500005,5000080],[500005,5000020]]]}}'
collection() { printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[%s]}' "$1"; }
cat >>site.toml <<'END'
[ground.rough]
polygon_file = "rough.geojson"
friction_deg = 60
cor = 0
END
speed() { # speed FEATURES: the largest of the run
  collection "$1" >rough.geojson
  expect 0 run_dda -o run.h5 --overwrite --json
  sed -n 's/.*"largest_speed_m_s": \([0-9.]*\).*/\1/p' out | head -n 1
}
once=$(speed "$polygon")
twice=$(speed "$polygon,$polygon")
says "rough.geojson: layer rough, 2 polygons of 15,000 m2 in all; 2 that overlap or touch were united to 1"
nested=$(speed "$polygon,$inner")
[ "$twice" = "$once" ] || fail "a polygon named twice: $twice m/s, once $once m/s"
[ "$nested" = "$once" ] || fail "a polygon in another one: $nested m/s, without it $once m/s"
grep -q '"layers_read"' out || fail "the result does not name the layers"

make_site
# surfaces of faces are not areas
for surface in TIN POLYHEDRALSURFACE; do
  printf 'id,WKT\n1,"%s Z (((500000 5000000 1,500150 5000000 1,500150 5000100 1,500000 5000000 1)))"\n' $surface >surface.csv
  rm -f faces.gpkg
  ogr2ogr -q -f GPKG -nln faces -a_srs EPSG:32632 faces.gpkg surface.csv 2>/dev/null
  { cat site.toml && printf '[ground.rough]\npolygon_file = "faces.gpkg"\nfriction_deg = 60\n'; } >faces.toml
  expect 1 talus-dda faces.toml --trn slope.tif --blocks blocks.h5 --no-db --set solver.blocks=alone -o faces.h5
  says "faces.gpkg: layer faces: holds no polygons, but 1 surface; expected polygons or closed lines"
done
