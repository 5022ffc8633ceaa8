# No output takes the place of a file that is read or that the site file names, under any name.
printf hello >in.txt
kept() { [ "$(cat "$1")" = "$2" ] || fail "$1 holds $(cat "$1")"; nothing_left; }
ln -s in.txt link.txt
ln in.txt hard.txt
mkdir folder
ln -s ../in.txt folder/far.txt
for name in ./in.txt "$PWD/in.txt" folder/../in.txt link.txt hard.txt folder/far.txt; do
  expect 2 frame-probe in.txt -o "$name" --overwrite
  says "$name: is both an input and an output"
done
expect 2 frame-probe link.txt -o in.txt --overwrite
expect 2 frame-probe in.txt -o new.txt --db hard.txt --overwrite
says "hard.txt: is both an input and an output"
kept in.txt hello

# files that formats keep beside it
printf where >in.prj
for name in in.prj in.txt.aux.xml in.txt-wal; do
  expect 2 frame-probe in.txt -o "$name" --overwrite
  says "$name: is both an input and an output"
done
kept in.prj where
expect 0 frame-probe in.txt -o in.json --no-db
expect 0 frame-probe in.txt -o other.prj --no-db

# files that the site file names: those that this tool reads, that it does not, with a layer, in an
# archive
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
awk 'BEGIN { print "ncols 24\nnrows 24\nxllcenter 500000\nyllcenter 5200000\ncellsize 2"
  for (r = 0; r < 24; r++) { line = ""; for (c = 0; c < 24; c++) line = line " " 100 - r; print line } }' >slope.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 slope.asc dem.tif
expect 0 talus-trn dem.tif -o trn.tif --no-db
cat >area.geojson <<'END'
{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32633"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[500010,5200010],[500030,5200010],[500030,5200030],[500010,5200010]]]}}]}
END
ogr2ogr -q -nln area map.gpkg area.geojson
ogr2ogr -q -nln area set/area.shp area.geojson 2>/dev/null || { mkdir set && ogr2ogr -q -nln area set/area.shp area.geojson; }
(cd set && python3 -m zipfile -c ../set.zip area.shp area.shx area.dbf area.prj)
cat >site.toml <<'END'
[site]
crs = "EPSG:32633"
[terrain]
dem = "dem.tif"
[blocks.a]
shape = "box"
size_m = [1, 1, 1]
position_m = [500020, 5200020]
[place.p]
polygon_file = "map.gpkg|layername=area"
[place.q]
polygon_file = "set.zip/area.shp"
[place.r]
polygon_file = "area.geojson"
END
cksum dem.tif map.gpkg set.zip area.geojson site.toml >before
ln -s map.gpkg alias.gpkg
named() {
  expect 2 talus-blocks site.toml --trn trn.tif "$@" --overwrite
  says "is both an output and a file that the site file names"
}
for name in dem.tif map.gpkg alias.gpkg set.zip "$PWD/area.geojson"; do named -o "$name" --no-db; done
named -o b.h5 --report area.geojson --no-db
named -o b.h5 --db map.gpkg
named -o b.h5 --report map.gpkg-wal --no-db
# also where the command line names another one in its place
named -o b.h5 --report area.geojson --set place.r.polygon_file=map.gpkg --no-db
cp area.geojson third.geojson
named -o b.h5 --report third.geojson --set place.r.polygon_file=third.geojson --no-db
expect 2 talus-blocks site.toml --trn trn.tif -o b.h5 --report site.toml --overwrite --no-db
says "site.toml: is both an input and an output"
cksum dem.tif map.gpkg set.zip area.geojson site.toml >after
cmp before after || fail "an input was replaced"
expect 0 talus-blocks site.toml --trn trn.tif -o b.h5 --report b.json --no-db
nothing_left
