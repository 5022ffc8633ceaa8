# Rasters that cannot be a terrain are refused with the remedy, and leave nothing behind.
grid() { # grid NAME CELLSIZE VALUE...: 3 x 3 ASCII grid in local coordinates
  name=$1 size=$2
  shift 2
  printf 'ncols 3\nnrows 3\nxllcorner 500000\nyllcorner 5000000\ncellsize %s\nNODATA_value -9999\n' "$size" >"$name"
  printf '%s %s %s\n' "$@" >>"$name"
}
refused() { # refused FINDING COMMAND...
  finding=$1
  shift
  expect 1 "$@"
  says "$finding"
  nothing_left bad.tif bad.json bad.png
}
out="-o bad.tif --report bad.json --hillshade bad.png"

grid good.asc 10 1 2 3 4 5 6 7 8 9
gdal_translate -q -a_srs EPSG:32632 good.asc good.tif

# a picture of the ground is not the ground, with a place on the map or without
gdaldem hillshade -q good.tif shade.tif
refused "as the shades of a picture" talus-trn shade.tif $out
says "give the elevation model itself"
gdal_translate -q -of PNG shade.tif shade.png
refused "as the shades of a picture" talus-trn shade.png $out
rm -f shade.png.aux.xml
refused "as the shades of a picture" talus-trn shade.png $out
# heights that are truly whole metres below 256 pass by the command that is named
gdal_translate -q -ot Byte -a_nodata none good.tif bytes.tif
refused "as the shades of a picture" talus-trn bytes.tif $out
says "gdal_translate -ot Float32 bytes.tif heights.tif"
gdal_translate -q -ot Float32 bytes.tif heights.tif
expect 0 talus-trn heights.tif -o whole_metres.tif --no-db -q

# CRS
refused "there is no CRS" talus-trn good.asc $out
gdal_translate -q -a_srs EPSG:4326 -a_ullr 11.33 47.05 11.34 47.04 good.asc degrees.tif
refused "in degrees" talus-trn degrees.tif $out
says "--t-srs EPSG:32632 reprojects"
gdal_translate -q -a_srs EPSG:2225 -a_ullr 6000000 2100000 6000030 2099970 good.asc feet.tif
refused "US survey foot" talus-trn feet.tif $out
says "--t-srs EPSG:26910 reprojects"
# heights of a plan in feet: in either unit, so nothing is assumed
refused "nothing says what unit the heights are in" talus-trn feet.tif $out --t-srs EPSG:32610
says "--vertical-crs"
gdal_translate -q -a_srs EPSG:3857 good.asc mercator.tif
refused "whose metres are stretched here" talus-trn mercator.tif $out
expect 2 talus-trn good.asc $out --crs EPSG:nonsense
says "is not a CRS"
refused "the CRS is EPSG:32632" talus-trn good.tif $out --crs EPSG:31287
refused "no CRS to reproject from" talus-trn good.asc $out --crs none --t-srs EPSG:32632
gdal_translate -q -of VRT good.tif feet_high.vrt
sed -i 's#<NoDataValue>#<UnitType>ft</UnitType><NoDataValue>#' feet_high.vrt
refused 'elevations are in "ft"' talus-trn feet_high.vrt $out

# the lattice
gdal_translate -q -a_srs EPSG:32632 -a_ullr 500000 5000030 500030 5000000.5 good.asc oblong.tif
refused "expected squares" talus-trn oblong.tif $out
says "-dstnodata nan -tr"
# each names the next ten times
gdal_translate -q -of VRT good.tif chain_6.vrt
for i in 5 4 3 2 1 0; do
  {
    echo '<VRTDataset rasterXSize="3" rasterYSize="3"><VRTRasterBand dataType="Float32" band="1">'
    for k in 1 2 3 4 5 6 7 8 9 10; do
      echo "<SimpleSource><SourceFilename relativeToVRT=\"1\">chain_$((i + 1)).vrt</SourceFilename></SimpleSource>"
    done
    echo '</VRTRasterBand></VRTDataset>'
  } >chain_$i.vrt
done
refused "more than 10000 virtual data sets" talus-trn chain_0.vrt $out

gdal_translate -q -of VRT good.tif rotated.vrt
sed -i 's#<GeoTransform>.*</GeoTransform>#<GeoTransform>500000,9.8,1.7,5000030,1.7,-9.8</GeoTransform>#' rotated.vrt
refused "rotated" talus-trn rotated.vrt $out
gdal_translate -q -of VRT good.tif south_up.vrt
sed -i 's#<GeoTransform>.*</GeoTransform>#<GeoTransform>500000,10,0,5000000,0,10</GeoTransform>#' south_up.vrt
refused "from north to south" talus-trn south_up.vrt $out
gdal_translate -q -of VRT good.tif nowhere.vrt
sed -i 's#<GeoTransform>.*</GeoTransform>##' nowhere.vrt
refused "no place on the map" talus-trn nowhere.vrt $out
gdal_translate -q -of VRT good.tif nan_cell.vrt
sed -i 's#<GeoTransform>.*</GeoTransform>#<GeoTransform>500000,nan,0,5000030,0,-10</GeoTransform>#' nan_cell.vrt
refused "expected a finite size above 0" talus-trn nan_cell.vrt $out

# the values
grid unknown.asc 10 -9999 -9999 -9999 -9999 -9999 -9999 -9999 -9999 -9999
refused "there is no ground" talus-trn unknown.asc $out --crs EPSG:32632
grid checkered.asc 10 -9999 1 -9999 1 -9999 1 -9999 1 -9999
refused "there is no ground" talus-trn checkered.asc $out --crs EPSG:32632
sed 's/NODATA_value.*/NODATA_value -1/' unknown.asc | sed '7s/-9999/5/' >undeclared.asc
refused "row 0, column 1 (500015, 5000025): the elevation is -9999 m" talus-trn undeclared.asc $out --crs EPSG:32632
says "gdal_translate -a_nodata -9999"
grid huge.asc 10 1 2 3 4 3.4e38 6 7 8 9
refused "row 1, column 1" talus-trn huge.asc $out --crs EPSG:32632
printf '\0\0\200\77\0\0\200\77\0\0\200\177\0\0\200\77' >infinite.bin  # 1 1 inf 1
printf 'ENVI\nsamples = 2\nlines = 2\nbands = 1\ndata type = 4\ninterleave = bsq\nbyte order = 0\nmap info = {UTM, 1, 1, 500000, 5000020, 10, 10, 32, North, WGS-84}\n' >infinite.hdr
refused "row 1, column 0 (500005, 5000005): the elevation is inf" talus-trn infinite.bin $out

# the file
gdal_translate -q -a_srs EPSG:32632 -outsize 400 400 -r bilinear good.asc large.tif
head -c 300000 large.tif >cut.tif
refused "damaged or cut short" talus-trn cut.tif $out
head -c 100 large.tif >stump.tif
refused "cannot be opened as a raster" talus-trn stump.tif $out
head -n 8 good.asc >cut.asc
refused "damaged or cut short" talus-trn cut.asc $out --crs EPSG:32632
echo "this is no raster" >words.tif
refused "cannot be opened as a raster" talus-trn words.tif $out
gdal_translate -q -b 1 -b 1 good.tif two_bands.tif
refused "has 2 bands" talus-trn two_bands.tif $out
expect 1 talus-trn missing.tif $out
nothing_left bad.tif

# window, cell, outputs
refused "the grid asked for lies outside" talus-trn good.tif $out --window 600000,5000000,600030,5000030
refused "expected at least 2 x 2" talus-trn good.tif $out --cell-size-m 25
refused "expected at most 268435456" talus-trn good.tif $out --cell-size-m 0.0001
gdal_translate -q -of VRT -a_ullr 300000 5000030 300003 5000027 good.tif lying.vrt
sed -i 's/rasterXSize="3" rasterYSize="3"/rasterXSize="300000" rasterYSize="400000"/' lying.vrt
refused "300000 x 400000 nodes, expected at most" talus-trn lying.vrt $out
expect 2 talus-trn good.tif $out --co COMPRESS=ZSTD
says "hint: --co is gone: write gdal_translate -co"
for words in 1,2,3 1,2,3,x 5,5,5,9 1,2,3,4,5; do
  expect 2 talus-trn good.tif $out --window $words
  nothing_left bad.tif
done
for size in 0 -1 nan inf ten; do
  expect 2 talus-trn good.tif $out --cell-size-m $size
done
expect 1 talus-trn good.tif -o nowhere/bad.tif
expect 2 talus-trn good.tif -o good.tif --overwrite
says "good.tif"
cmp -s good.tif good.tif || fail "the input is gone"

# references
refused "the CRS is EPSG:25832" talus-trn good.tif $out --reference "$(gdal_translate -q -a_srs EPSG:25832 good.asc other.tif; echo other.tif)"
gdal_translate -q -a_srs EPSG:32632 -a_ullr 600000 5000030 600030 5000000 good.asc far.tif
refused "no place in common" talus-trn good.tif $out --reference far.tif
refused "the grid asked for lies outside" talus-trn good.tif $out --like far.tif --reference good.tif
