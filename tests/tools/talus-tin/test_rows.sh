# A table beside shapes has a row for each: where one is lost, all behind it have values of other
# shapes.
. "$source_dir/tests/tools/talus-tin/map.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
awk 'BEGIN {
  print "{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:25832\"}},\"features\":["
  for (l = 0; l <= 10; ++l)
    printf "%s{\"type\":\"Feature\",\"properties\":{\"ELEV\":%d},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[650000,%d],[650100,%d],[650200,%d]]}}", l ? "," : "", 1000 + 10 * l, 5200000 + 20 * l, 5200000 + 20 * l, 5200000 + 20 * l
  print "]}" }' >map.geojson
mkdir one two
ogr2ogr -q one/map.shp map.geojson
ogr2ogr -q two/map.shp map.geojson
ogr2ogr -q two/other.shp map.geojson
ogr2ogr -q -f 'MapInfo File' map.tab map.geojson
ogr2ogr -q -f 'MapInfo File' map.mif map.geojson
for whole in one/map.shp one map.tab map.mif; do expect 0 talus-tin $whole --overwrite -o whole.ply --no-db; done

# a row that is lost, one too many, and a table that was cut short
cat >rows.py <<'PY'
import struct, sys
name, change = sys.argv[1:]
data = open(name, 'rb').read()
n, begin, size = struct.unpack('<IHH', data[4:12])
rows = [data[begin + i * size:begin + (i + 1) * size] for i in range(n)]
if change == 'fewer': rows = rows[1:]
if change == 'more': rows = rows[:1] + rows
body = b''.join(rows)
if change == 'short': rows, body = rows, body[:-3 * size]
open(name, 'wb').write(data[:4] + struct.pack('<I', len(rows)) + data[8:begin] + body + b'\x1a')
PY
refused() { # refused SOURCE TABLE ROWS
  expect 1 talus-tin "$1" -o bad.ply --no-db
  says "$2: the table has $3 rows, the file beside it 11 shapes"
  nothing_left bad.ply
}
for change in 'fewer 10' 'more 12' 'short 8'; do
  set -- $change
  for source in one/map.shp map.tab; do
    table=$(echo $source | sed 's/shp$/dbf/; s/tab$/dat/')
    cp $table kept
    python3 rows.py $table $1
    refused $source $table $2
    cp kept $table
  done
done

# the remedy: a copy without the table has all shapes
mkdir bare
cp one/map.shp one/map.shx one/map.prj bare
[ "$(ogrinfo -so bare map | grep 'Feature Count')" = 'Feature Count: 11' ] || fail "shapes were lost"
expect 1 talus-tin bare/map.shp -o bad.ply --no-db
if grep -q rows err; then fail "shapes without a table are taken for a table without rows"; fi

# in a folder, in an archive, and where other files than contours are read
python3 rows.py one/map.dbf fewer
refused one one/map.dbf 10
python3 -c "import shutil; shutil.make_archive('one', 'zip', 'one')"
refused one.zip /vsizip/one.zip/map.dbf 10
expect 1 talus-tin map.geojson --breaklines one/map.shp -o bad.ply --no-db
says "one/map.dbf: the table has 10 rows"
python3 rows.py two/other.dbf fewer
expect 1 talus-tin 'two|layername=map' -o bad.ply --no-db
says "two/other.dbf: the table has 10 rows"

# MapInfo's text
for change in 1d 1p; do
  sed $change map.mid >other.mid
  cp map.mif other.mif
  expect 1 talus-tin other.mif -o bad.ply --no-db
  says "other.mid: the table has $(wc -l <other.mid) rows, the file beside it 11 shapes"
  nothing_left bad.ply
done
