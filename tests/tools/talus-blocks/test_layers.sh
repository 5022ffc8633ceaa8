# Which layer, which polygon: several layers are listed, polygons are united, and both are said.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
sed 's/^polygon = .*/polygon_file = "areas.gpkg"/' site.toml >areas.toml
polygon() { # polygon XMIN YMIN XMAX YMAX: a feature
  printf '{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[%s,%s],[%s,%s],[%s,%s],[%s,%s],[%s,%s]]]}}' \
    "$1" "$2" "$3" "$2" "$3" "$4" "$1" "$4" "$1" "$2"
}
collection() { # collection FILE FEATURE...
  file=$1 features=$2
  shift 2
  for feature in "$@"; do features="$features,$feature"; done
  printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},"features":[%s]}' \
    "$features" >"$file"
}
line='{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[500000,5200000],[500040,5200040]]}}'
area=$(polygon 500012 5200012 500034 5200034)
study=$(polygon 500006 5200006 500040 5200040)
cut() { talus-blocks areas.toml --trn trn.tif -o blocks.h5 --overwrite --no-db --json "$@"; }

# two layers of polygons: refused with their names, and with the key that the hint names it works
collection study.geojson "$study"
collection area.geojson "$area"
ogr2ogr -q areas.gpkg study.geojson -nln study_area
ogr2ogr -q -update areas.gpkg area.geojson -nln release
expect 1 cut
says "areas.gpkg: 2 layers hold polygons, expected one; the layers are: study_area, release"
says "hint: put \"|layername=study_area\" behind the file; several: \"|layername=study_area,release\""
nothing_left blocks.h5
expect 0 cut --set 'source.polygon_file=areas.gpkg|layername=release'
says "areas.gpkg: layer release, 1 polygon of 484 m2 in all"
cp out release.json
volume=$(value release.json prism_volume_m3)
python3 - <<'PY' || fail 'layers_read'
import json
entry, = json.load(open('release.json'))['layers_read']
assert entry['input'] == 'source' and entry['layer'] == 'release' and entry['n_polygons'] == 1, entry
assert abs(entry['area_m2'] - 484) < 1e-6 and entry['n_united'] == 0, entry
PY

# a first layer of any geometry, without a polygon, does not hide the release behind it
collection line.geojson "$line"
rm areas.gpkg
ogr2ogr -q areas.gpkg line.geojson -nln lines -nlt GEOMETRY
ogr2ogr -q -update areas.gpkg area.geojson -nln release
expect 0 cut
says "layer release, 1 polygon"
holds "$(value out prism_volume_m3) == $volume"

# a layer that also holds a line: the line is counted, and warned of
collection mixed.geojson "$line" "$area"
rm areas.gpkg
ogr2ogr -q areas.gpkg mixed.geojson -nln mixed -nlt GEOMETRY
expect 0 cut
says "layer mixed: also holds 1 open line, passed over"
holds "$(value out prism_volume_m3) == $volume"

# repeated, nested and adjoining polygons are the area that they cover
united() { # united FEATURE...: the same mass
  collection areas.geojson "$@"
  rm -f areas.gpkg
  ogr2ogr -q areas.gpkg areas.geojson
  expect 0 cut
  holds "($(value out prism_volume_m3) - $volume) ^ 2 < 1e-12"
}
united "$area" "$area"
says "2 polygons of 484 m2 in all; 2 that overlap or touch were united to 1"
united "$area" "$(polygon 500018 5200018 500028 5200028)"
united "$(polygon 500012 5200012 500024 5200034)" "$(polygon 500024 5200012 500034 5200034)"
united "$(polygon 500012 5200012 500026 5200034)" "$(polygon 500020 5200012 500034 5200034)"

# a polygon that crosses itself: where
collection bow.geojson '{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[500012,5200012],[500034,5200034],[500034,5200012],[500012,5200034],[500012,5200012]]]}}'
rm areas.gpkg
ogr2ogr -q areas.gpkg bow.geojson
expect 1 cut
says "the polygon is not sound: Self-intersection"
says "500023 5200023"
says "hint: put its corners in order there; of many polygons: ogr2ogr -makevalid mended.gpkg areas.gpkg"
ogr2ogr -makevalid mended.gpkg areas.gpkg
mv mended.gpkg areas.gpkg
expect 1 cut # two triangles that touch in a point alone are not a single area
says "two outlines of the source area meet"

# release points: the layer is said, two are refused
cat >points.toml <<'SITE'
[site]
crs = "EPSG:32633"
[rockfall.a]
shape = "box"
size_m = [1, 1, 1]
release_file = "points.gpkg"
[material.rock]
SITE
collection points.geojson '{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[500020,5200020]}}'
ogr2ogr -q points.gpkg points.geojson -nln a
expect 0 talus-blocks points.toml --trn trn.tif -o points.h5 --no-db
says "points.gpkg: layer a, 1 point"
ogr2ogr -q -update points.gpkg points.geojson -nln b
expect 1 talus-blocks points.toml --trn trn.tif -o other.h5 --no-db
says "2 layers hold points, expected one; the layers are: a, b"
says "hint: put \"|layername=a\" behind the file"
expect 0 talus-blocks points.toml --trn trn.tif -o other.h5 --no-db --set 'rockfall.a.release_file=points.gpkg|layername=b'

# --- every key that names a vector file takes all that the reader takes
# -------------------------------
is_release() { # is_release ARGUMENTS...: the mass is that of the release area
  expect 0 cut "$@"
  holds "($(value out prism_volume_m3) - $volume) ^ 2 < 1e-12"
}
rm areas.gpkg
ogr2ogr -q areas.gpkg study.geojson -nln study_area
ogr2ogr -q -update areas.gpkg area.geojson -nln release
is_release --set 'source.polygon_file=areas.gpkg|layername=release'
grep -q '"layer": "release"' out || fail "the layer is not in the result"
collection named.geojson "$(printf %s "$study" | sed 's/"properties":{}/"properties":{"kind":"study"}/')" \
  "$(printf %s "$area" | sed 's/"properties":{}/"properties":{"kind":"release"}/')"
is_release --set "source.polygon_file=named.geojson|subset=kind = 'release'"
says "named.geojson: layer named where kind = 'release', 1 polygon of 484 m2 in all"
expect 2 cut --set source.polygon_layer=release
says 'hint: write polygon_file = "FILE|layername=LAYER"'
ogr2ogr -q whole.shp area.geojson
python3 - <<'PY'
import zipfile
with zipfile.ZipFile('whole.zip', 'w') as archive:
    for end in ('shp', 'shx', 'dbf', 'prj'): archive.write('whole.' + end)
PY
is_release --set source.polygon_file=whole.zip
# a closed line of a drawing; of two layers of the drawing one must be named
square() { # square LAYER XMIN YMIN XMAX YMAX
  printf '0\nLWPOLYLINE\n100\nAcDbEntity\n8\n%s\n100\nAcDbPolyline\n90\n4\n70\n1\n' "$1"
  printf '10\n%s\n20\n%s\n' "$2" "$3" "$4" "$3" "$4" "$5" "$2" "$5"
}
{
  printf '0\nSECTION\n2\nENTITIES\n'
  square RELEASE 500012 5200012 500034 5200034
  square STUDY 500006 5200006 500040 5200040
  printf '0\nENDSEC\n0\nEOF\n'
} >areas.dxf
expect 1 cut --set source.polygon_file=areas.dxf
says "2 layers of the drawing hold polygons, expected one; they are: RELEASE (1), STUDY (1)"
is_release --set 'source.polygon_file=areas.dxf|layername=RELEASE'
says "1 closed line taken as areas"
# release points from a table
printf 'name;Easting;Northing\na;500020,0;5200020,0\n' >points.csv
expect 0 talus-blocks points.toml --trn trn.tif -o table.h5 --no-db --set rockfall.a.release_file=points.csv
says "points.csv: x from Easting, y from Northing"
says "points.csv: layer points, 1 point"

# --- commands of hints ----------------------------------------------------------------------------
hint() { sed -n 's/^  hint: //p' err; }
# metres that the file calls degrees, with a code for the word of the hint
sed 's/"crs":{[^}]*}},//' area.geojson >metres.geojson
expect 1 cut --set source.polygon_file=metres.geojson
says "the coordinates are not degrees"
eval "$(hint | sed 's/.*\(ogr2ogr.*\)/\1/; s/EPSG:code/EPSG:32633/')"
is_release --set source.polygon_file=named.gpkg
# a layer named as QGIS does is a word of its own in the command, which mends it alone
ogr2ogr -q -update areas.gpkg bow.geojson -nln "two triangles"
expect 1 cut --set 'source.polygon_file=areas.gpkg|layername=two triangles'
says "the polygon is not sound"
rm -f mended.gpkg
eval "$(hint | sed 's/.*polygons: //')"
ogrinfo -so mended.gpkg >layers
[ "$(grep -c '^[0-9]*: ' layers)" = 1 ] && grep -q 'two triangles' layers || fail "the hint mended $(cat layers)"
