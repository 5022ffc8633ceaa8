# Imported data become metres in one system, with every decision recorded; a TIN made from it is the
# one that is made from the files themselves.
. "$source_dir/tests/tools/talus-tin/map.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
cone 32632 1 >map.geojson
printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[{"type":"Feature","properties":{"hoehe_nn":138},"geometry":{"type":"Point","coordinates":[500000,5200000]}}]}' >spot.geojson
ogr2ogr -q -t_srs EPSG:25833 far.gpkg spot.geojson
printf '{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[499900,5199900],[500050.25,5199900],[500050.25,5200100],[499900,5200100],[499900,5199900]],[[499930,5199990],[499940,5199990],[499940,5200000],[499930,5199990]]]}}]}' >part.geojson
cat >site.toml <<'END'
[terrain]
contours = "map.geojson"
elevation_field = "ELEV, spots=hoehe_nn"
spots = "far.gpkg"
boundary = "part.geojson"
END
expect 0 talus-import site.toml -o inputs.gpkg --report import.json
says "far.gpkg: reprojected from EPSG:25833 (ETRS89 / UTM zone 33N) to EPSG:32632 (WGS 84 / UTM zone 32N)"
prints "contours: 4 lines, 100 to 130 m, median 110 m"
expect 0 talus-tin inputs.gpkg -o imported.ply --report imported.json
expect 0 talus-tin map.geojson -o direct.ply --elevation-field ELEV --spots far.gpkg --elevation-field spots=hoehe_nn \
  --boundary part.geojson --report direct.json
cmp -s direct.ply imported.ply || fail "the border changes the TIN"
ogrinfo -q inputs.gpkg decisions >decisions
for words in 'question (String) = system' 'answer (String) = field hoehe_nn' 'why (String) = --elevation-field' \
  'file (String) = far.gpkg'; do
  grep -qF "$words" decisions || fail "no decision says: $words"
done
ogrinfo -q inputs.gpkg magnitudes | grep -q 'median (Real) = 138' || fail "no median of the spot heights"
grep -q '"answer": "field hoehe_nn"' import.json || fail "the report holds no decision"
expect 0 talus-import site.toml -o again.gpkg
cmp -s inputs.gpkg again.gpkg || fail "the same inputs give other bytes"

# settled properties are not said again; options of the import override the site
expect 2 talus-tin inputs.gpkg -o bad.ply --t-srs EPSG:25833
says "was written by talus-import, with 3 layers, and says units, fields and systems itself"
says "hint: give layers, fields, units and systems to talus-import (make IMPORT_FLAGS)"
nothing_left bad.ply
expect 0 talus-import site.toml -o other.gpkg --t-srs EPSG:25833
expect 0 talus-tin other.gpkg -o imported.ply --overwrite
expect 0 talus-tin map.geojson -o direct.ply --elevation-field ELEV --spots far.gpkg --elevation-field spots=hoehe_nn \
  --boundary part.geojson --t-srs EPSG:25833 --overwrite
cmp -s direct.ply imported.ply || fail "the border changes a TIN that is reprojected"

# heights in another unit, local metres, points
cone "" >local.geojson
cat >local.toml <<'END'
[terrain]
contours = "local.geojson"
END
expect 0 talus-import local.toml -o local.gpkg --crs none --elevation-unit-m 0.5
expect 0 talus-tin local.gpkg -o imported.ply --overwrite
expect 0 talus-tin local.geojson -o direct.ply --crs none --elevation-unit-m 0.5 --overwrite
cmp -s direct.ply imported.ply || fail "local metres pass the border as something else"
awk 'BEGIN { for (i = 0; i < 60; i++) for (j = 0; j < 60; j++) printf "%.2f,%.2f,%.3f\n", 500000 + i + 0.1 * (j % 3), 5200000 + j, 100 + i / 2 + (i * j) % 7 / 10 }' >survey.csv
printf '[terrain]\ncontours = "survey.csv"\n' >survey.toml
expect 0 talus-import survey.toml -o survey.gpkg --points --crs EPSG:32632
prints "points: 3600 points, 100 to"
expect 0 talus-tin survey.gpkg -o imported.ply --overwrite
expect 0 talus-tin survey.csv --points --crs EPSG:32632 -o direct.ply --overwrite
cmp -s direct.ply imported.ply || fail "points pass the border as something else"

# a file that was only looked at, one that was changed since, and a layer of it
ogr2ogr -q -update -nln more inputs.gpkg map.geojson
expect 0 talus-tin inputs.gpkg -o looked_at.ply
ogrinfo -q inputs.gpkg -sql "DELETE FROM contours WHERE fid = 1" >/dev/null
expect 1 talus-tin inputs.gpkg -o bad.ply
says "inputs.gpkg: was changed since talus-import wrote it"
says "or take a layer of it as it is: 'inputs.gpkg|layername=contours'"
expect 0 talus-tin 'inputs.gpkg|layername=contours' -o changed.ply --t-srs EPSG:25833
expect 1 talus-import site.toml --set terrain.contours=none.geojson -o bad.gpkg
printf '[terrain]\n' >none.toml
expect 1 talus-import none.toml -o bad.gpkg
says "[terrain] names neither contours nor dem"
says "hint: name what the ground is made from: --set terrain.contours=FILE, or terrain.dem"
nothing_left bad.gpkg
