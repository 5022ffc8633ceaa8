# Settings of GDAL and PROJ that somebody has in the environment, in gdalrc or in proj.ini do not
# change a byte; the values of a grid of PROJ change the run id.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
# a raster whose place depends on how it is read, circles as contours, and a source in another zone
gdal_translate -q -ot Float64 -a_srs EPSG:32633 -mo AREA_OR_POINT=Point slope.asc point.tif
{
  printf '0\nSECTION\n2\nENTITIES\n'
  for ring in 0 1 2 3; do
    printf '0\nCIRCLE\n8\nC\n10\n500100\n20\n5200100\n30\n1%d0\n40\n%d\n' $ring $((100 - 20 * ring))
  done
  printf '0\nENDSEC\n0\nEOF\n'
} >rings.dxf
printf 'id,wkt\n1,"POLYGON ((500012 5200012, 500034 5200012, 500034 5200034, 500012 5200034, 500012 5200012))"\n' >area.csv
ogr2ogr -q -t_srs EPSG:32632 -s_srs EPSG:32633 -nlt POLYGON area.shp area.csv -oo GEOM_POSSIBLE_NAMES=wkt
sed 's/^polygon = .*/polygon_file = "area.shp"/' site.toml >file.toml

# everything FOLDER: terrains, triangles and blocks; the command that comes before each is in `with`
with=env
everything() {
  mkdir "$1"
  expect 0 $with talus-trn point.tif -o "$1/here.tif" --no-db
  expect 0 $with talus-trn point.tif -o "$1/there.tif" --t-srs EPSG:32632 --no-db
  expect 0 $with talus-tin rings.dxf -o "$1/rings.ply" --crs EPSG:32633 --t-srs EPSG:32632 --no-db
  expect 0 $with talus-blocks file.toml --trn trn.tif -o "$1/blocks.h5" --no-db
}
same() {
  everything "$1"
  for file in here.tif there.tif rings.ply blocks.h5; do
    cmp plain/$file "$1/$file" || fail "$1: $file has other bytes"
  done
}
everything plain

hostile="GTIFF_POINT_GEO_IGNORE=YES OGR_ARC_STEPSIZE=45 OSR_DEFAULT_AXIS_MAPPING_STRATEGY=AUTHORITY_COMPLIANT
  OGR_ENABLE_PARTIAL_REPROJECTION=YES SHAPE_RESTORE_SHX=YES SHAPE_ENCODING=CP437 GDAL_SKIP=ESRIShapefile
  GDAL_DISABLE_READDIR_ON_OPEN=EMPTY_DIR GDAL_VALIDATE_CREATION_OPTIONS=NO DXF_INLINE_BLOCKS=FALSE GTIFF_SRS_SOURCE=EPSG"
with="env $(echo $hostile) PROJ_NETWORK=ON PROJ_NETWORK_ENDPOINT=http://127.0.0.1:9 PROJ_USE_PROJ4_INIT_RULES=YES
  PROJ_FORCE_SEARCH_PIVOT=YES OGR_NTF_OPTIONS=FORCE_GENERIC=ON SPATIALITE_TINYPOINT=1 CPL_DEBUG=ON TZ=Pacific/Chatham LC_ALL=de_DE.UTF-8"
same variables
mkdir -p home/.gdal
{ echo '[configoptions]' && printf '%s\n' $hostile; } >home/.gdal/gdalrc
with="env HOME=$PWD/home"
same gdalrc
with="env GDAL_CONFIG_FILE=$PWD/home/.gdal/gdalrc"
same config_file

# where PROJ finds its data is kept; how it computes is not
command -v projinfo >/dev/null || skip "needs projinfo for the rest"
data=$(projinfo --searchpaths | while read -r folder; do [ ! -f "$folder/proj.db" ] || echo "$folder"; done | head -n 1)
mkdir proj
ln -s "$data/proj.db" proj/proj.db
printf '[general]\nnetwork = on\ntmerc_default_algo = evenden_snyder\n' >proj/proj.ini
with="env PROJ_DATA=$PWD/proj PROJ_LIB=$PWD/proj"
same proj_ini

# a grid of other content gives other places, and another run id
[ -f "$data/BETA2007.gsb" ] || skip "needs the grid BETA2007.gsb for the rest"
python3 - "$data/BETA2007.gsb" <<'PYTHON'
import struct, sys
grid = bytearray(open(sys.argv[1], "rb").read())
for at in range(22 * 16, len(grid) - 16, 16):  # behind two headers of eleven records
    struct.pack_into("<f", grid, at, struct.unpack_from("<f", grid, at)[0] + 0.1)  # seconds to the north
open("proj/BETA2007.gsb", "wb").write(grid)
PYTHON
gdal_translate -q -ot Float64 -a_srs EPSG:31467 -a_ullr 3550000 5300048 3550048 5300000 slope.asc gauss.tif
run_id() { gdalinfo "$1" | sed -n 's/^ *RUN_ID=//p'; }
expect 0 talus-trn gauss.tif -o one.tif --t-srs EPSG:25832 --no-db
expect 0 $with talus-trn gauss.tif -o other.tif --t-srs EPSG:25832 --no-db
[ -n "$(run_id one.tif)" ] || fail "no run id"
gdal_translate -q -of XYZ one.tif one.xyz
gdal_translate -q -of XYZ other.tif other.xyz
if cmp -s one.xyz other.xyz; then fail "the other grid was not taken: this test tells nothing"; fi
[ "$(run_id one.tif)" != "$(run_id other.tif)" ] || fail "another grid gave other heights by the same run id"
