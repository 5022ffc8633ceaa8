# Sources, fences and classes whose coordinates contradict their system are refused with the remedy.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
expect 0 blocks --report here.json
here=$(value here.json prism_volume_m3)
run_hint() { sed -n 's/; as metres: .*//; s/^ *hint: \(as feet: \)\{0,1\}//p' err >hint.sh && sh -e hint.sh >/dev/null; }
# refused POLYGON_FILE FINDING
refused() {
  sed "s/^polygon = .*/polygon_file = \"$1\"/" site.toml >other.toml
  expect 1 talus-blocks other.toml --trn trn.tif -o bad.h5 --no-db
  says "$2"
  nothing_left bad.h5
}
# taken POLYGON_FILE: gives the volume of the site
taken() {
  sed "s/^polygon = .*/polygon_file = \"$1\"/" site.toml >other.toml
  expect 0 talus-blocks other.toml --trn trn.tif -o there.h5 --overwrite --no-db --report there.json
  awk -v a="$here" -v b="$(value there.json prism_volume_m3)" 'BEGIN { exit !((a / b - 1) ^ 2 < 1e-6) }' ||
    fail "$1: $(value there.json prism_volume_m3) m3, expected $here"
}
cat >area.csv <<'CSV'
id,wkt
1,"POLYGON ((500012 5200012, 500034 5200012, 500034 5200034, 500012 5200034, 500012 5200012))"
CSV
ogr2ogr -q -f GPKG area.gpkg area.csv -oo GEOM_POSSIBLE_NAMES=wkt -a_srs EPSG:32633 -nlt POLYGON
taken area.gpkg

# x and y exchanged, with and without a CRS of its own
ogr2ogr -q -f GPKG -nln area exchanged.gpkg area.gpkg -dialect sqlite -sql 'SELECT SwapCoords(geom) AS geom, * FROM "area"' -a_srs EPSG:32633
ogr2ogr -q exchanged.shp exchanged.gpkg
rm -f exchanged.prj
for file in exchanged.gpkg exchanged.shp; do
  refused $file "with x and y exchanged they would lie in it"
  rm -f mended.gpkg
  run_hint
  taken mended.gpkg
done
# latitude before longitude
ogr2ogr -q -f GPKG degrees.gpkg area.gpkg -t_srs EPSG:4326
ogr2ogr -q -f GPKG -nln area latitude.gpkg degrees.gpkg -dialect sqlite -sql 'SELECT SwapCoords(geom) AS geom, * FROM "area"' -a_srs EPSG:4326
refused latitude.gpkg "with x and y exchanged they would lie in it"
# degrees called metres
ogr2ogr -q -f GPKG lying.gpkg degrees.gpkg -a_srs EPSG:32633
refused lying.gpkg "they look like degrees"
sed -n 's/^ *hint: .*: ogr2ogr/ogr2ogr/p' err >hint.sh
sh -e hint.sh
taken named.gpkg
says "reprojected from EPSG:4326 (WGS 84) to EPSG:32633 (WGS 84 / UTM zone 33N) by"
# a datum that is not known
ogr2ogr -q -f GPKG -a_srs "+proj=utm +zone=33 +ellps=bessel" bessel.gpkg area.gpkg
refused bessel.gpkg "PROJ knows no shift of the datum"

# a drawing in feet: the command of the hint
ogr2ogr -q -f DXF metres.dxf area.gpkg -dialect sqlite -sql "SELECT ST_Boundary(geom) FROM area"
printf '0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n2\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nHATCH\n100\nAcDbEntity\n8\nA\n100\nAcDbHatch\n10\n0\n20\n0\n30\n0\n210\n0\n220\n0\n230\n1\n2\nSOLID\n70\n1\n71\n0\n91\n1\n92\n3\n72\n0\n73\n1\n93\n4\n' >feet.dxf
for corner in "500012 5200012" "500034 5200012" "500034 5200034" "500012 5200034"; do
  printf '10\n%s\n20\n%s\n' $(echo "$corner" | awk '{ printf "%.9f %.9f", $1 / 0.3048, $2 / 0.3048 }')
done >>feet.dxf
printf '97\n0\n75\n1\n76\n1\n98\n0\n0\nENDSEC\n0\nEOF\n' >>feet.dxf
refused feet.dxf "the drawing is in feet (\$INSUNITS 2 in its header), expected metres"
run_hint
taken metres.gpkg

# coordinates of the site file itself
sed 's/EPSG:32633/EPSG:3329/' site.toml >other.toml
expect 1 talus-blocks other.toml --trn trn.tif -o bad.h5 --no-db
says "the eastings lack the zone number 5"
sed 's/EPSG:32633/EPSG:31468/' site.toml >other.toml
expect 1 talus-blocks other.toml --trn trn.tif -o bad.h5 --no-db
says "hint: is it the CRS of these coordinates? crs of [site] says so"
sed 's/^polygon = .*/polygon = [[5200012, 500012], [5200034, 500012], [5200034, 500034], [5200012, 500034]]/' site.toml >other.toml
expect 1 talus-blocks other.toml --trn trn.tif -o bad.h5 --no-db
says "with x and y exchanged they would lie in it"
# an operation is kept in the message on the layer
ogr2ogr -q -f GPKG etrs.gpkg area.gpkg -t_srs EPSG:25833
sed 's/^polygon = .*/polygon_file = "etrs.gpkg"/' site.toml >other.toml
expect 0 talus-blocks other.toml --trn trn.tif -o there.h5 --overwrite --report there.json
grep -q '"operation": "reprojected from EPSG:25833' there.json || fail "the report does not say how it was reprojected"
talus-runs show 1 >show
grep -q "reprojected from EPSG:25833" show || fail "the registry does not hold the operation"
nothing_left bad.h5
