# Polygons of a ground section are united; a fence that stands twice is refused.
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

# the same corners in the site file and in the file beside it
sed 's/polygon_file = "rough.geojson"/&\npolygon = [[500000, 5000000], [500150, 5000000], [500150, 5000100], [500000, 5000100]]/' site.toml >both.toml
expect 0 talus-dda both.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o both.h5 --json
grep -q "\"largest_speed_m_s\": $once" out || fail "a polygon in file and site file cancels itself"

# the area of a section holds also where it is the only one: elsewhere nothing is said
for area in 'polygon = [[500000, 5000000], [500150, 5000000], [500150, 5000100]]' 'polygon_file = "rough.geojson"' 'raster_values = [1]'; do
  awk -v area="$area" '/^\[/ { in_ground = /^\[ground/ } !in_ground { print } END { print "[ground.only]"; print area }' site.toml >only.toml
  expect 1 talus-dda only.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o only.h5
  says "no section [ground.*] holds outside the polygons and where the raster says nothing"
done

# corners out of order
sed 's/polygon_file = .*/polygon = [[500000, 5000000], [500150, 5000100], [500150, 5000000], [500000, 5000100]]/' site.toml >bow.toml
expect 1 talus-dda bow.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o bow.h5
says "the polygon is not sound: Self-intersection"
says "500075 5000050"
says "hint: put the corners in order around the area"

# fences: the same line, reversed, in pieces, from a file
make_site
stands() { sed 's/active = false/capacity_kj = 2000/' site.toml; }
fence() { printf '[fence.%s]\nline = %s\n%s\n' "$1" "$2" "$3"; }
refused() { # refused SITE WORDS...
  site=$1
  shift
  expect 1 talus-dda "$site" --trn slope.tif --blocks blocks.h5 --no-db --independent -o f.h5
  for words in "$@"; do says "$words"; done
  nothing_left f.h5
}
{ stands; fence again '[[500060, 5000010], [500060, 5000090]]' 'capacity_kj = 2000'; } >same.toml
refused same.toml "fence.again: lies on fence low all along, from 500060, 5000010 on" \
  "hint: leave one of the two sections out, or set its active = false"
{ stands; fence again '[[500060, 5000090], [500060, 5000050], [500060, 5000010]]' ''; } >reversed.toml
refused reversed.toml "fence.again: lies on fence low all along, from 500060, 5000090 on"
{ fence again '[[500060, 5000030], [500060, 5000050]]' ''; stands; } >part.toml
refused part.toml "fence.again: lies on fence low all along"
{ stands; fence again '[[500060, 5000010], [500060, 5000090]]' 'active = false'; } >watched.toml
expect 0 talus-dda watched.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o f.h5
says "warning: fence again lies on fence low all along"
{ stands; fence beside '[[500062, 5000010], [500062, 5000090]]' ''; } >beside.toml
expect 0 talus-dda beside.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o f.h5 --overwrite
line='{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[500060,5000010],[500060,5000090]]}}'
collection "$line,$line" >lines.geojson
rm f.h5
sed 's/^line = .*/line_file = "lines.geojson"/' site.toml >file.toml
refused file.toml "fence.low.2: lies on fence low.1 all along" "hint: delete the repeated line in the file"
collection "$line" >lines.geojson
expect 0 talus-dda file.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o f.h5
says "lines.geojson: layer lines, 1 line"

# fences that share a part of their lines; crossing ones and those that meet do not
{ stands; fence beyond '[[500060, 5000050], [500060, 5000098]]' 'capacity_kj = 2000'; } >half.toml
rm -f f.h5
refused half.toml "fence.beyond: lies on fence low along 40 m, from 500060, 5000050 on" \
  "hint: end one of them where the other one begins"
{ stands; fence skew '[[500060.05, 5000098], [500060.05, 5000060], [500080, 5000060]]' ''; } >skew.toml
refused skew.toml "fence.skew: lies on fence low along 30"
{ stands; fence beyond '[[500060, 5000050], [500060, 5000098]]' 'active = false'; } >half.toml
expect 0 talus-dda half.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o f.h5
says "warning: fence beyond lies on fence low along 40 m"
{ stands; fence next '[[500060, 5000090], [500060, 5000098]]' ''; fence over '[[500055, 5000040], [500065, 5000045]]' ''; } >meet.toml
expect 0 talus-dda meet.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o f.h5 --overwrite
if grep -q 'lies on' err; then fail "fences that meet or cross share no ground: $(cat err)"; fi

# surfaces of faces are no areas
for surface in TIN POLYHEDRALSURFACE; do
  printf 'id,WKT\n1,"%s Z (((500000 5000000 1,500150 5000000 1,500150 5000100 1,500000 5000000 1)))"\n' $surface >surface.csv
  rm -f faces.gpkg
  ogr2ogr -q -f GPKG -nln faces -a_srs EPSG:32632 faces.gpkg surface.csv 2>/dev/null
  { cat site.toml && printf '[ground.rough]\npolygon_file = "faces.gpkg"\nfriction_deg = 60\n'; } >faces.toml
  expect 1 talus-dda faces.toml --trn slope.tif --blocks blocks.h5 --no-db --independent -o faces.h5
  says "faces.gpkg: layer faces: holds no polygons, but 1 surface; expected polygons or closed lines"
done
