# Sources as QGIS and download sites name them are written in a site file, and make follows their
# files.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
site plain
made plain terrain
site named
( # the contours in two layers beside an older map, the source in a zip
  cd named
  ogr2ogr -q -where "elevation_m < 50" -nln low map.gpkg contours.gpkg
  ogr2ogr -q -update -where "elevation_m >= 50" -nln high map.gpkg contours.gpkg
  ogr2ogr -q -update -where "elevation_m < 20" -nln older map.gpkg contours.gpkg
  mv contours.gpkg contours_now.gpkg
)
layers() { sed "s#^contours = .*#contours = \"$1\"\n$2#" plain/site.toml >named/site.toml; }
stages() { talus-site named/site.toml -o named/stages --overwrite --no-db; }

# of the file, its layers and its filter, the rule names the file alone
layers 'map.gpkg|layername=older|subset=elevation_m < 10' ''
expect 0 stages
grep -q '^SITE_CONTOURS := named/map.gpkg$' named/stages/site.mk || fail "$(grep CONTOURS named/stages/site.mk)"
layers map.gpkg 'layer = "low"'
expect 1 stages
says 'hint: write contours = "FILE|layername=LAYER"'
layers 'none.gpkg|layername=older' ''
expect 1 stages
says "there is no file named/none.gpkg"

layers 'map.gpkg|layername=low, high' ''
made named terrain
gdalinfo -checksum plain/out/trn.tif | grep Checksum >expected
gdalinfo -checksum named/out/trn.tif | grep Checksum >found
cmp -s expected found || fail "the map in two layers gives another terrain"
made named -n terrain
if grep -q '^talus-' out; then fail "nothing changed, and make would start a tool"; fi
touch named/map.gpkg
made named -n terrain
if grep -q '^talus-' out; then fail "the map was touched, and make would start a tool"; fi
(cd named && ogr2ogr -q -update -where "elevation_m < 30" -nln lowest map.gpkg contours_now.gpkg)
made named -n terrain
prints "talus-tin"

# names and filters with signs of make and of the shell
(cd named && ogr2ogr -q -update -nln "heights #2 50 % (\$x) 'new'" map.gpkg contours_now.gpkg)
cat >more.toml <<'END'
contours = "map.gpkg|layername=heights #2 50 % ($x) 'new'|subset=elevation_m < 1000 AND '#a,b)' <> '$(x)'"
END
sed -e '/^contours/r more.toml' -e '/^contours/d' plain/site.toml >named/site.toml
made named terrain
gdalinfo -checksum named/out/trn.tif | grep Checksum >found
cmp -s expected found || fail "a layer with signs of make gives another terrain"
layers map.gpkg ''
for part in "high|subset='#,)(' <> 'a' AND elevation_m > 3" "high|subset='#,)(' <> 'b' AND elevation_m > 3" \
  "heights #2 50 % (\$\$x) 'new'"; do
  made named CONTOURS="map.gpkg|layername=$part" terrain
  prints "import: what the site names"
  made named CONTOURS="map.gpkg|layername=$part" -n terrain
  if grep -q '^talus-' out; then fail "nothing changed, and make would start a tool with the layer $part"; fi
done
