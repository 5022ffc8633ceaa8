# Scattered points of the ground become a TIN: text, vector layers; other contents are refused.
. "$source_dir/tests/tools/talus-tin/map.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
awk 'BEGIN { srand(7); print "id;Easting;Northing;Height (m);code"
  for (i = 1; i <= 900; ++i) { x = 200 * rand(); y = 200 * rand()
    printf "%d;%.2f;%.2f;%.3f;GR\n", i, 500000 + x, 5200000 + y, 800 + 0.25 * x + 0.5 * y } }' >survey.csv
awk -F';' 'NR > 1 { print $2, $3, $4 }' survey.csv >survey.xyz
expect 0 talus-tin survey.csv --points -o csv.ply --crs EPSG:32632 --report csv.json
says "survey.csv: x from Easting, y from Northing"
says "elevation from field Height (m) of layer survey"
prints "900 points of the ground"
expect 0 talus-tin survey.xyz --points -o xyz.ply --crs EPSG:32632
says "x from column 1, y from column 2"
says "elevation from field z of layer survey"
cmp csv.ply xyz.ply || fail "the same points give another TIN"
expect 0 talus-trn csv.ply -o plane.tif --cell-size-m 5 --window 500010,5200010,500190,5200190 --report plane.json
awk -v s="$(sed -n 's/.*"mean_deg": \([0-9.]*\),*/\1/p' plane.json)" 'BEGIN { exit !((s - 29.206) ^ 2 < 1e-4) }' ||
  fail "a plane is no plane: $(grep mean_deg plane.json)"

# points in a layer, in another CRS, within a boundary
ogr2ogr -q -f GPKG survey.gpkg survey.csv -oo X_POSSIBLE_NAMES=Easting -oo Y_POSSIBLE_NAMES=Northing -oo AUTODETECT_TYPE=YES \
  -a_srs EPSG:32632 -nln survey
expect 0 talus-tin survey.gpkg --points -o layer.ply --elevation-field "Height (m)"
cmp csv.ply layer.ply || fail "a layer gives another TIN"
expect 0 talus-tin survey.gpkg --points -o moved.ply --elevation-field "Height (m)" --t-srs EPSG:32633
printf '{"type":"Polygon","coordinates":[[[500050,5200050],[500150,5200050],[500150,5200150],[500050,5200150],[500050,5200050]]]}' >b.geojson
ogr2ogr -q -a_srs EPSG:32632 b.gpkg b.geojson
expect 0 talus-tin survey.csv --points -o part.ply --crs EPSG:32632 --boundary b.gpkg
talus-trn part.ply -o part.tif --cell-size-m 5 --no-db -q

# impossible points, and doubtful ones: refused, warned of, written as places
sed '400s/;[0-9.]*;GR/;0;GR/' survey.csv >zero.csv
expect 1 talus-tin zero.csv --points -o bad.ply --crs EPSG:32632 --doubts zero.gpkg
says "zero.csv: point at 0 m"
nothing_left bad.ply
[ "$(ogrinfo -so zero.gpkg doubts | grep 'Feature Count')" = "Feature Count: 1" ] || fail "one place expected"
expect 0 talus-tin zero.csv --points -o zero.ply --crs EPSG:32632 --accept-doubts
awk -F';' -v OFS=';' 'NR == 400 { $4 += 100 } 1' survey.csv >spike.csv
expect 0 talus-tin spike.csv --points -o spike.ply --crs EPSG:32632
says "m, as beside it"
(cat survey.xyz; sed -n '5s/$/9/p' survey.xyz | awk '{ print $1, $2, $3 + 4 }') >twice.xyz
expect 1 talus-tin twice.xyz --points -o bad.ply --crs EPSG:32632
says "m, as beside it"
(cat survey.xyz; echo 503000 5200100 850) >far.xyz
expect 0 talus-tin far.xyz --points -o far.ply --crs EPSG:32632
says "warning: triangles span gaps of up to"

# hints where the option is missing, or the file is a scan
expect 1 talus-tin survey.csv -o bad.ply
says "hint: --points makes a TIN of points of the ground"
expect 1 talus-tin survey.gpkg -o bad.ply --elevation-field "Height (m)"
says "hint: --points makes a TIN of points of the ground"
expect 1 talus-tin survey.csv --points -o bad.ply
says "there is no CRS, expected a projected one in metres"
printf 'LASF' >scan.laz
expect 1 talus-tin scan.laz --points -o bad.ply
says "is a laser scan, which is not read as it is"
says 'pdal translate scan.laz ground.csv -f filters.range --filters.range.limits="Classification[2:2]"'
expect 2 talus-tin survey.csv --points -o bad.ply --spots survey.gpkg
nothing_left bad.ply
