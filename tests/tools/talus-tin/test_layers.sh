# Which layer, which lines, which field: several layers of databases and drawings, other shapes
# beside, Z that is not a number, names as QGIS and download sites write them. The truth is one map.
. "$source_dir/tests/tools/talus-tin/map.sh"
cone >map.geojson
expect 0 talus-tin map.geojson -o truth.ply
data truth.ply >expected
is_truth() { # is_truth ARGUMENTS...: the map of these arguments is the whole map
  expect 0 talus-tin "$@" -o found.ply --overwrite --report found.json
  data found.ply >found
  cmp -s expected found || fail "talus-tin $* gives another terrain"
}
triangles() { # triangles PLY: their corners bit by bit, in an order of their own
  python3 - "$1" <<'END'
import re, struct, sys
head, data = open(sys.argv[1], "rb").read().split(b"end_header\n", 1)
n_points, n_triangles = (int(n) for n in re.findall(rb"\nelement \w+ (\d+)", head))
corners = list(struct.iter_unpack("<ddd", data[:24 * n_points]))
faces = list(struct.iter_unpack("<Biii", data[24 * n_points:]))
assert len(faces) == n_triangles > 0 and all(face[0] == 3 for face in faces)
for triangle in sorted(sorted(corners[i] for i in face[1:]) for face in faces):
    print(triangle)
END
}
is_map() { # is_map ARGUMENTS...: as is_truth, though the lines are in another order
  expect 0 talus-tin "$@" -o found.ply --overwrite --report found.json
  triangles truth.ply >expected_triangles
  triangles found.ply >found_triangles
  cmp -s expected_triangles found_triangles || fail "talus-tin $* gives other triangles"
  for key in n_lines lowest_m highest_m interval_m n_triangles; do
    [ "$(value found.json $key)" = "$(value truth.json $key)" ] ||
      fail "talus-tin $*: $key is $(value found.json $key), expected $(value truth.json $key)"
  done
}
refused() { # refused WORDS ARGUMENTS...
  words=$1
  shift
  expect 1 talus-tin "$@" -o bad.ply
  says "$words"
  nothing_left bad.ply
}
hint() { sed -n 's/^  hint: //p' err; }
expect 0 talus-tin map.geojson -o truth.ply --overwrite --report truth.json

# --- two layers of one database -------------------------------------------------------------------
ogr2ogr -q -where "ELEV IN (100, 120)" -nln index two.gpkg map.geojson
ogr2ogr -q -update -where "ELEV IN (110, 130)" -nln between two.gpkg map.geojson
refused "2 layers hold lines, expected one; the layers are: index, between" two.gpkg
says 'hint: put "|layername=index" behind the file; several: "|layername=index,between"; all: "|layername=*"'
eval "is_map two.gpkg$(hint | sed 's/.*several: \(".*"\); .*/\1/')"
says "elevation from Z of layer index, between"
is_map 'two.gpkg|layername=index, between'
is_map 'two.gpkg|layername=*'
is_map 'two.gpkg|layername=index,between'
refused "there is no layer \"index,betwen\"; there are: index, between" 'two.gpkg|layername=index,betwen'
refused 'there is no layer " "; there are: index, between' 'two.gpkg|layername= '
refused 'there is no layer ","' 'two.gpkg|layername=,'
expect 2 talus-tin two.gpkg -o bad.ply --layer index
says "hint: --layer is gone: write 'FILE|layername=LAYER'"
odd_name='line one
line two'
ogr2ogr -q -nln "$odd_name" odd.gpkg map.geojson
ogr2ogr -q -update -nln other odd.gpkg map.geojson
is_map "odd.gpkg|layername=$odd_name"
ogr2ogr -q -update -nln far -t_srs EPSG:32633 two.gpkg map.geojson
refused "the CRS of layer index is" 'two.gpkg|layername=index,far'
# one map in 2-D, whose layers call the elevation by different names
ogr2ogr -q -dim XY -sql "SELECT ELEV AS elevation FROM map WHERE ELEV > 110" -nln high names.gpkg map.geojson
ogr2ogr -q -dim XY -update -sql "SELECT ELEV AS hoehe FROM map WHERE ELEV < 120" -nln low names.gpkg map.geojson
is_map 'names.gpkg|layername=high,low'
says "elevation from field elevation, hoehe of layer high, low"
# a filter takes the wanted lines of a layer
cone 32632 0.5 >small.geojson
sed 's/"ELEV"/"OLD":1,"ELEV"/' small.geojson >old.geojson
ogr2ogr -q -nln map filter.gpkg map.geojson
ogr2ogr -q -append -update -addfields -nln map filter.gpkg old.geojson
is_truth 'filter.gpkg|subset=OLD IS NULL'
says "filter OLD IS NULL"
is_truth 'filter.gpkg|layername=map|subset=OLD IS NULL'
refused "filter \"NONE = 1\"" 'filter.gpkg|subset=NONE = 1'
refused "leaves no feature" 'filter.gpkg|subset=ELEV > 9000'

# --- drawings -------------------------------------------------------------------------------------
polyline() { # polyline LAYER HEIGHT CLOSED X,Y...
  layer=$1 height=$2 closed=$3
  shift 3
  printf '0\nLWPOLYLINE\n100\nAcDbEntity\n8\n%s\n100\nAcDbPolyline\n90\n%s\n70\n%s\n38\n%s\n' "$layer" $# "$closed" "$height"
  for point in "$@"; do printf '10\n%s\n20\n%s\n' "${point%,*}" "${point#*,}"; done
}
drawing() { printf '0\nSECTION\n2\nENTITIES\n'; cat; printf '0\nENDSEC\n0\nEOF\n'; }
contour() { polyline "$1" "$2" 0 500000,"$3" 500050,"$3" 500100,"$3"; }
contours() {
  for k in 0 1 2 3 4; do
    layer=BETWEEN
    [ $((k % 4)) = 0 ] && layer=INDEX
    contour $layer $((100 + 10 * k)) $((5200000 + 20 * k))
  done
}
{ contours; polyline ROAD 0 0 500020,5199990 500030,5200090; } | drawing >two.dxf
contours | sed 's/BETWEEN/INDEX/' | drawing >one.dxf
expect 0 talus-tin one.dxf --crs EPSG:32632 -o one.ply
says "elevation from Z of layer INDEX"
data one.ply >expected
refused "3 layers of the drawing hold lines, expected one; they are: BETWEEN (3), INDEX (2), ROAD (1)" two.dxf --crs EPSG:32632
is_truth 'two.dxf|layername=INDEX,BETWEEN' --crs EPSG:32632
is_truth "two.dxf|subset=Layer <> 'ROAD'" --crs EPSG:32632
is_truth 'two.dxf|layername=[!R]*?,INDEX' --crs EPSG:32632
refused "layer RAOD: holds no lines" 'two.dxf|layername=INDEX,RAOD' --crs EPSG:32632
refused "the drawing has nothing in a layer \"NONE\"; its layers are: INDEX, BETWEEN, ROAD" 'two.dxf|layername=NONE' --crs EPSG:32632

# a closed line of a drawing, or of another file, is a boundary; an open one is none
expect 0 talus-tin one.dxf --crs EPSG:32632 -o whole.ply --report whole.json
limit="500000,5200000 500050,5200000 500050,5200080 500000,5200080"
polyline LIMIT 0 1 $limit | drawing >limit.dxf
expect 0 talus-tin one.dxf --crs EPSG:32632 -o half.ply --boundary limit.dxf --report half.json
says "limit.dxf: layer LIMIT, 1 polygon"
says "limit.dxf: 1 closed line taken as areas"
[ "$(value half.json area_m2)" = 4000.0 ] || fail "half of 8000 m2 has $(value half.json area_m2)"
lines "0:500000,5200000;500050,5200000;500050,5200080;500000,5200080;500000,5200000" >limit.geojson
expect 0 talus-tin one.dxf --crs EPSG:32632 -o half2.ply --boundary limit.geojson
cmp -s half.ply half2.ply || fail "the same boundary as GeoJSON gives another terrain"
polyline LIMIT 0 0 $limit | drawing >open.dxf
refused "holds no polygons, but 1 open line; expected polygons or closed lines" one.dxf --crs EPSG:32632 --boundary open.dxf

# splines are strokes; GDAL 3.6 reads no heights of them, later ones do
spline() { printf '0\nSPLINE\n100\nAcDbEntity\n8\nC\n100\nAcDbSpline\n70\n8\n71\n1\n72\n4\n73\n2\n74\n0\n40\n0\n40\n0\n40\n1\n40\n1\n10\n500000\n20\n%s\n30\n%s\n10\n500100\n20\n%s\n30\n%s\n' "$1" "$2" "$1" "$2"; }
{ spline 5200000 100; spline 5200050 110; } | drawing >spline.dxf
if talus-tin spline.dxf --crs EPSG:32632 -o spline.ply --report spline.json 2>err; then
  [ "$(value spline.json lowest_m) $(value spline.json highest_m)" = '100.0 110.0' ] || fail "heights of splines: $(cat spline.json)"
else
  refused "2 of 2 are splines (SPLINE), whose Z GDAL does not read" spline.dxf --crs EPSG:32632
  says "hint: turn them into 3-D polylines"
  { contours | sed 's/BETWEEN/INDEX/'; spline 5200100 150 | sed 's/^C$/INDEX/'; } | drawing >mixed.dxf
  refused "1 of 6 are splines (SPLINE), whose Z GDAL does not read" mixed.dxf --crs EPSG:32632
fi

# --- other shapes beside --------------------------------------------------------------------------
data truth.ply >expected
point='{"type":"Feature","properties":{"ELEV":100},"geometry":{"type":"Point","coordinates":[500000,5200000]}}'
sed "s/^]}$/,$point]}/" map.geojson >labels.geojson
is_truth labels.geojson
says "layer labels also holds 1 point, passed over"
[ "$(value found.json n_passed_over)" = 1 ] || fail "the point is not counted in the report"
sed 's/"geometry":\(.*\)}\(,*\)$/"geometry":{"type":"GeometryCollection","geometries":[\1,{"type":"Point","coordinates":[1,2]}]}}\2/' map.geojson >collection.geojson
is_truth collection.geojson
says "also holds 4 points, passed over"
# areas: outlines that are each at one height, by the command of the hint
sed 's/"LineString","coordinates":\(.*\)}}/"Polygon","coordinates":[\1]}}/' map.geojson >areas.geojson
refused "holds no lines, but 4 polygons; expected lines" areas.geojson
eval "$(hint | sed 's/.*height: \(.*\); bands.*/\1/')"
is_truth lines.gpkg
# bands, with the lower height of each as a hole's: the same command does not make a terrain of them
band() { # band HEIGHT OUTER INNER
  awk -v z="$1" -v r1="$2" -v r2="$3" 'function ring(r, i, s) { s = ""; for (i = 0; i <= 24; ++i) s = s (i ? "," : "") sprintf("[%.6f,%.6f]", 500000 + r * cos(i % 24 * 3.14159265 / 12), 5200000 + r * sin(i % 24 * 3.14159265 / 12)); return "[" s "]" }
    BEGIN { printf "{\"type\":\"Feature\",\"properties\":{\"ELEV\":%d},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[%s,%s]}}", z, ring(r1), ring(r2) }'
}
printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[%s,%s]}' "$(band 100 100 80)" "$(band 110 80 60)" >bands.geojson
rm lines.gpkg
ogr2ogr -q -nlt MULTILINESTRING lines.gpkg bands.geojson
refused "meets contour" lines.gpkg

# --- Z and fields ---------------------------------------------------------------------------------
# Z that is not a number beside a good field, in a GeoPackage and in a Shapefile
ogr2ogr -q -nln nan nan.gpkg map.geojson
ogr2ogr -q -lco SHPT=ARCZ nan.shp map.geojson
python3 - <<'PY'
import struct
for name in ('nan.gpkg', 'nan.shp'):
    content = open(name, 'rb').read()
    for height in (100, 110, 120, 130):
        content = content.replace(struct.pack('<d', height), struct.pack('<d', float('nan')))
    open(name, 'wb').write(content)
PY
for file in nan.gpkg nan.shp; do
  is_truth $file
  says "elevation from field ELEV"
  says "Z of 4 of 4 is not a number and was ignored"
  is_truth $file --elevation-field ELEV
  refused "the Z of 4 of 4 is not a finite number" $file --elevation-field Z
done
ogr2ogr -q -dialect OGRSQL -sql "SELECT ELEV AS OTHER, NAME FROM nan" unnamed.gpkg nan.gpkg
refused "the Z of 4 of 4 is not a finite number, and no field with a usual name holds heights" unnamed.gpkg
says "hint: name the field with --elevation-field FIELD; the fields are: OTHER, NAME"
is_truth unnamed.gpkg --elevation-field OTHER

# a field called Z beside another Z: refused with both names, each of which works
sed 's/"ELEV":1\([0-3]\)0/"Z":2\100/' map.geojson >z.geojson
refused "has Z 100 and a field Z of 2000, expected the same height" z.geojson
says "by Z: --elevation-field geometry.Z; by the field: --elevation-field field.Z"
refused "has Z 100 and a field Z of 2000, expected the same height" z.geojson --elevation-field Z
is_truth z.geojson --elevation-field geometry.Z
expect 0 talus-tin z.geojson -o field.ply --elevation-field field.Z --report field.json
[ "$(value field.json lowest_m)" = 2000.0 ] || fail "field.Z gives $(value field.json lowest_m)"

# two fields with usual names that say different heights; one that is the same everywhere says none
ogr2ogr -q -dim XY -sql "SELECT ELEV, ELEV * 3.28 AS HEIGHT, 0 AS ALT FROM map" rivals.gpkg map.geojson
refused "has ELEV 100 and HEIGHT 328, expected the same height" rivals.gpkg
says "by ELEV the heights go from 100 to 130 m; by HEIGHT the heights go from 328 to 426.4 m"
says "hint: by ELEV: --elevation-field ELEV; by HEIGHT: --elevation-field HEIGHT"
is_truth rivals.gpkg --elevation-field ELEV
ogr2ogr -q -dim XY -sql "SELECT ELEV, ELEV * 3.28 AS ELEV_FT, 0 AS ALT FROM map" feet.gpkg map.geojson
is_truth feet.gpkg
# the unit is said
expect 0 talus-tin rivals.gpkg --elevation-field ELEV --elevation-unit-m 0.5 -o unit.ply
says "elevation from field ELEV of layer map, in units of 0.5 m"

# --- archives and tables --------------------------------------------------------------------------
ogr2ogr -q -lco SHPT=ARCZ whole.shp map.geojson
python3 - <<'PY'
import zipfile
parts = ['whole.' + end for end in ('shp', 'shx', 'dbf', 'prj')]
with zipfile.ZipFile('whole.zip', 'w') as archive:
    for part in parts: archive.write(part)
with zipfile.ZipFile('folder.zip', 'w') as archive:
    for part in parts: archive.write(part, 'maps/' + part)
    archive.writestr('maps/readme.txt', 'terms of use')
with zipfile.ZipFile('two.zip', 'w') as archive:
    archive.write('two.gpkg')
    archive.write('map.geojson')
PY
for file in whole.zip folder.zip whole.zip/whole.shp /vsizip/folder.zip/maps/whole.shp '/vsizip/folder.zip/maps/whole.shp|layername=whole'; do
  is_truth "$file"
done
refused "the archive holds 2 vector files, expected one; they are: map.geojson, two.gpkg" two.zip
is_truth "$(hint | sed 's/name one: //')"
gzip -k map.geojson
is_truth map.geojson.gz
# a member named in an archive, or by a part of a name, is part of the run's id
is_truth folder.zip
one=$(value found.json run_id)
is_truth folder.zip/maps/whole.shp
[ "$(value found.json run_id)" != "$one" ] || fail "another name in the archive has the same run id"

printf 'number;Easting;Northing;Elevation\n1;500000,0;5200000,0;138,25\n2;500003,0;5200000,0;138,0\n' >spots.csv
printf '500000 5200000 138.25\n500003.0 5200000.0 138.0\n' >spots.xyz
printf '\357\273\277z,y,x\r\n138.25,5200000,500000\r\n138,5200000,500003\r\n' >mark.csv
expect 0 talus-tin map.geojson -o csv.ply --spots spots.csv --json
prints '"elevation_from": "field Elevation"'
says "spots.csv: x from Easting, y from Northing"
for file in spots.xyz mark.csv; do
  expect 0 talus-tin map.geojson -o found.ply --overwrite --spots $file
  cmp -s csv.ply found.ply || fail "$file gives another terrain than spots.csv"
done
printf 'x,y,z\n500000,5200000,138\n500003,n/a,138\n' >bad.csv
refused "bad.csv:3: says \"n/a\", expected a number" map.geojson --spots bad.csv
# a table in UTF-16, by the command of the hint
iconv -f UTF-8 -t UTF-16 mark.csv >wide.csv
refused "is written in UTF-16, expected UTF-8" map.geojson --spots wide.csv
eval "$(hint)"
expect 0 talus-tin map.geojson -o found.ply --overwrite --spots columns.csv
cmp -s csv.ply found.ply || fail "the table of the hint gives another terrain"
