# The content of an input counts, not its time: an older file is seen, a touched one is not.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v gdalbuildvrt >/dev/null || skip "needs gdal-bin"
gdal_translate -q -ot Float64 -a_srs EPSG:32633 -a_ullr 499996 5200324 500228 5199996 \
  "$source_dir/sample_sites/designed/slope.asc" dem.tif
gdal_translate -q -scale 0 1000 0 1001 dem.tif other.tif

would() {
  made slope -n "$@"
  tools=$(sed -n 's/^talus-\([a-z]*\) .*/\1/p' out | sort -u | tr '\n' ' ')
}
would_be() { [ "$tools" = "$1" ] || fail "$2: make would start: $tools, expected $1"; }
# replaced FILE BY: with a time from before everything
replaced() {
  cp "$2" "$1"
  touch -d 2020-01-01 "$1"
}

site slope
sed -i -e 's/^contours = .*/dem = "dem.tif"/' -e '/^elevation_field/d' slope/site.toml
cp dem.tif slope/dem.tif
made slope terrain
would terrain
would_be "" "nothing changed"
touch slope/dem.tif slope/site.toml
would terrain
would_be "" "other times"
replaced slope/dem.tif other.tif
would terrain
would_be "import trn " "an older elevation model"
cp dem.tif slope/dem.tif
would terrain
would_be "" "a dry run writes nothing"
replaced slope/dem.tif other.tif
cksum <slope/out/trn.tif >before
made slope terrain
if cksum <slope/out/trn.tif | cmp -s - before; then fail "the terrain of an older elevation model is the old one"; fi

# of the same size, with the time of the old one, on the same inode
sleep 4
would terrain
made slope terrain
touch -r slope/dem.tif stamp
printf 'x' | dd of=slope/dem.tif bs=1 seek=8 conv=notrunc 2>/dev/null
touch -r stamp slope/dem.tif
made slope -n blocks
prints "talus-trn"
replaced slope/dem.tif other.tif
made slope terrain

# given to make
cp dem.tif slope/mine.tif
made slope terrain DEM=mine.tif
would terrain DEM=mine.tif
would_be "" "nothing changed"
replaced slope/mine.tif other.tif
would terrain DEM=mine.tif
would_be "import trn " "an older elevation model given to make"
made slope terrain DEM=mine.tif TRN_FLAGS='--reference dem.tif'
replaced slope/dem.tif dem.tif
would terrain DEM=mine.tif TRN_FLAGS='--reference dem.tif'
would_be "import trn " "an older reference"

# files that a data set is made of: its CRS, the parts of a mosaic
gdal_translate -q -of AAIGrid dem.tif slope/grid.asc
made slope terrain DEM=grid.asc
gdalsrsinfo -o wkt1 EPSG:32632 >other.prj
replaced slope/grid.prj other.prj
would terrain DEM=grid.asc
would_be "import trn " "another CRS beside it"
gdalbuildvrt -q slope/mosaic.vrt slope/mine.tif
made slope terrain DEM=mosaic.vrt
replaced slope/mine.tif dem.tif
would terrain DEM=mosaic.vrt
would_be "import trn " "an older part of a mosaic"
gdalbuildvrt -q slope/mosaics.vrt slope/mosaic.vrt
made slope terrain DEM=mosaics.vrt
replaced slope/mine.tif other.tif
would terrain DEM=mosaics.vrt
would_be "import trn " "an older part of a mosaic of mosaics"
made slope terrain DEM=mine.tif
gdalinfo -stats slope/mine.tif >/dev/null
[ -s slope/mine.tif.aux.xml ] || fail "no statistics beside the elevation model"
would terrain DEM=mine.tif
would_be "" "statistics beside it"

# contours, and a manifest of data
site map
made map terrain
replaced map/contours.gpkg "$source_dir/sample_sites/maungawhau/contours.gpkg"
made map -n terrain
prints "talus-tin"
cp "$source_dir/sample_sites/designed/contours.gpkg" map/contours.gpkg
(cd map && sha256sum contours.gpkg >manifest.sha256)
made map terrain
replaced map/contours.gpkg "$source_dir/sample_sites/maungawhau/contours.gpkg"
expect 2 make -C map BIN= terrain
says "The data of this site are missing or differ"

# results with times of the future, of a clock that was set back: a stage changed now is repeated
# all the same
rm map/manifest.sha256
cp "$source_dir/sample_sites/designed/contours.gpkg" map/contours.gpkg
made map terrain
touch -d '+1 hour' map/out/trn.tif map/out/trn.json map/out/hillshade.png
touch -d '+30 seconds' map/out/tin.ply map/out/tin.json
made map -n terrain
prints "Nothing to be done"
made map -s terrain
[ ! -s out ] || fail "times of the future alone repeat a stage: $(cat out)"
touch -d '+1 hour' map/out/tin.ply map/out/tin.json map/out/trn.tif map/out/trn.json
sed -i 's/^cell_size_m = 8/cell_size_m = 4/' map/site.toml
made map -n terrain
prints "talus-trn"
made map terrain
gdalinfo map/out/trn.tif | grep -q 'Pixel Size = (4.0' || fail "a terrain of the future was left as it was"
