# Layers of a site.gpkg define sections of the site file: the same results, and an edited fence is
# taken up by make and repeats the stages that read fences.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
edit() { ogrinfo -q "$1/site.gpkg" -sql "$2" >edited 2>&1 || { cat edited >&2; fail "cannot edit: $2"; }; }
shown() { ogrinfo -q -al "$1" | grep -E '^ +(POLYGON|LINESTRING|MULTI)' | sort; }

# the designed site, with its source and fence in a file as it is made
site plain
site drawn
expect 0 talus-site --new-layers drawn/site.gpkg --crs-of drawn/contours.gpkg --no-db
prints "14 layers in EPSG:32633"
edit drawn "INSERT INTO source (geom) VALUES (AsGPB(GeomFromText('MULTIPOLYGON(((500096 5200248, 500144 5200248, 500144 5200296, 500096 5200296, 500096 5200248)))', 32633)))"
edit drawn "INSERT INTO fences (geom, name, height_m, active) VALUES (AsGPB(GeomFromText('LINESTRING(500060 5200150, 500164 5200150)', 32633)), 'valley', 8, 1)"
sed -e '/^polygon = /d' -e '/^\[fence.valley\]/,$d' -e 's/^crs = .*/&\nlayers = "site.gpkg"/' plain/site.toml >drawn/site.toml
expect 0 talus-site drawn/site.toml -o stages --print-config
prints 'fence.valley.height_m = 8  # site.gpkg, layer fences, feature 1'
made plain maps fence
made drawn maps fence
for file in tin.ply trn.tif; do cmp plain/out/$file drawn/out/$file || fail "$file differs"; done
for file in bed maps/reach maps/velocity; do
  gdalinfo -checksum plain/out/$file.tif | grep Checksum >expected
  gdalinfo -checksum drawn/out/$file.tif | grep Checksum >found
  cmp -s expected found || fail "$file.tif has other values"
done
shown plain/out/fence.gpkg >expected
shown drawn/out/fence.gpkg >found
cmp -s expected found || fail "the fence lies elsewhere"
[ -s found ] || fail "there is no fence"

# looked at, touched, packed anew, a style or a remark written: nothing is made again, and ids stay
id_of_source() {
  expect 0 talus-source drawn/site.toml --trn drawn/out/trn.tif -o source.json --overwrite --db ids.sqlite
  sqlite3 ids.sqlite "SELECT content_id FROM run ORDER BY id DESC LIMIT 1"
}
before=$(id_of_source)
edit drawn "UPDATE fences SET remark = 'moved last year'"
edit drawn "UPDATE source SET remark = 'drawn anew'"
edit drawn "VACUUM"
[ "$(id_of_source)" = "$before" ] || fail "a remark makes another run id"
made drawn -n fence
if grep -q '^talus-' out; then fail "no value changed, and make would start a tool"; fi

# moved, as QGIS writes it while it has the file open: into the journal beside it
cat >move.py <<'PY'
import sqlite3, subprocess, sys
from osgeo import ogr
line = ogr.CreateGeometryFromWkt("LINESTRING (500060 5200160, 500164 5200160)")
db = sqlite3.connect("drawn/site.gpkg")
db.execute("PRAGMA journal_mode = WAL")
for name in ("ST_MinX", "ST_MaxX", "ST_MinY", "ST_MaxY", "ST_IsEmpty"):
    db.create_function(name, 1, lambda blob, n=name: 0 if n == "ST_IsEmpty" else 0.0)
head = db.execute("SELECT geom FROM fences").fetchone()[0][:8]  # magic, version, flags, SRS
flags = bytes([head[3] & 0xF1])  # without an envelope
db.execute("UPDATE fences SET geom = ?", (head[:3] + flags + head[4:8] + bytes(line.ExportToWkb(ogr.wkbNDR)),))
db.commit()  # stays open, so that the journal stays
sys.exit(subprocess.call(sys.argv[1:]))
PY
if python3 -c 'from osgeo import ogr' 2>/dev/null; then
  expect 0 python3 move.py make -C drawn BIN= -n fence
  prints talus-batch
  if grep -q '^talus-blocks' out; then fail "another fence cuts the blocks again"; fi
fi
edit drawn "UPDATE fences SET height_m = 6"
made drawn -n fence
prints talus-batch
if grep -q '^talus-blocks' out; then fail "another height of a fence cuts the blocks again"; fi
edit drawn "INSERT INTO places (geom, name) SELECT geom, 'school' FROM source"
made drawn -n runs
if grep -q '^talus-blocks' out; then fail "a place cuts the blocks again"; fi

# contradictions
stages() { talus-site drawn/site.toml -o stages --overwrite --no-db; }
edit drawn "INSERT INTO fences (geom) SELECT geom FROM fences WHERE name = 'valley'"
expect 1 stages
says "site.gpkg, layer fences, feature 2: has no name"
edit drawn "UPDATE fences SET name = 'valley', height_m = 5 WHERE fid = 2"
expect 1 stages
says "height_m is 5, that of site.gpkg, layer fences, feature 1 is 6"
edit drawn "UPDATE fences SET name = 'upper', height_m = -5 WHERE fid = 2"
expect 1 stages
says "site.gpkg, layer fences, feature 2: fence.upper.height_m is -5, expected above 0"
edit drawn "DELETE FROM fences WHERE fid = 2"
edit drawn "ALTER TABLE fences ADD COLUMN capacity_k REAL"
edit drawn "UPDATE fences SET capacity_k = 500"
expect 1 stages
says "has a field capacity_k that is not a key"
says "did you mean capacity_kj?"
edit drawn "UPDATE fences SET capacity_k = NULL"
printf '[fence.valley]\nheight_m = 8\n' >>drawn/site.toml
expect 1 stages
says "height_m of [fence.valley] stands here and in drawn/site.toml:"
edit drawn "UPDATE fences SET height_m = NULL"
expect 0 stages
grep -q 'fence.valley.height_m = 8$' stages/run.txt || fail "the section of the file has no say"
expect 2 talus-site drawn/site.toml -o stages --overwrite --no-db --set site.layers=other.gpkg
says "cannot name site.layers"
# layers beside those of sections are named; one that is nearly one of them is refused as a field is
ogr2ogr -q -update drawn/site.gpkg drawn/site.gpkg source -nln roads
expect 0 stages
says "site.gpkg: layers that stand for no section: roads"
for pair in fence:fences ground:grounds sources:source Releasepoints:release_points; do
  ogr2ogr -q -update drawn/site.gpkg drawn/site.gpkg source -nln "${pair%:*}"
  expect 1 stages
  says "site.gpkg: has a layer ${pair%:*} that stands for no section"
  says "hint: did you mean ${pair#*:}? Rename the layer, or take it out"
  edit drawn "DROP TABLE \"${pair%:*}\""
done
expect 0 stages
# a folder of files is a source of layers as well
mkdir drawn/layers
for layer in source fences places; do ogr2ogr -q drawn/layers/$layer.shp drawn/site.gpkg $layer; done
mv drawn/layers/fences.dbf drawn/layers/fence.dbf
for part in shp shx prj; do mv drawn/layers/fences.$part drawn/layers/fence.$part; done
cp drawn/site.toml kept.toml
sed -i 's/^layers = .*/layers = "layers"/' drawn/site.toml
expect 1 stages
says "layers: has a layer fence that stands for no section"
cp kept.toml drawn/site.toml

sed -i 's/^layers = .*/layers = "absent.gpkg"/' drawn/site.toml
expect 1 stages
says "there is no file drawn/absent.gpkg"
