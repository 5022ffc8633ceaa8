# The nodes of a terrain are the DEM's cell centres, with the DEM's values bit for bit.
cat >dem.asc <<'END'
ncols 6
nrows 5
xllcorner 400000
yllcorner 5000000
cellsize 2.5
NODATA_value -32767
101.25 102.5 103.75 104 105.125 106
111.25 112.5 113.75 114 115.125 116
121.25 122.5 123.75 124 125.125 126
131.25 132.5 -32767 134 135.125 136
141.25 142.5 143.75 144 145.125 146
END
expect 1 talus-trn dem.asc -o no_crs.tif
says "there is no CRS"
says "--crs"
nothing_left no_crs.tif

expect 0 talus-trn dem.asc -o trn.tif --crs EPSG:32632 --report trn.json --hillshade trn.png
prints "6 x 5 nodes, 2.5 m apart, 96.7 % known"
[ -s trn.png ] || fail "no hillshade"
gdalinfo trn.tif >info
for line in "AREA_OR_POINT=Point" "NoData Value=-9999" "Unit Type: m" "Type=Float64" \
  "Origin = (400000.000000000000000,5000012.500000000000000)" "Pixel Size = (2.5" 'ID["EPSG",32632]' \
  "Description = elevation of the TRN's nodes" "COMPRESSION=DEFLATE" "RUN_ID="; do
  grep -qF "$line" info || fail "gdalinfo does not say: $line"
done
[ "$(gdallocationinfo -valonly -geoloc trn.tif 400001.25 5000011.25)" = 101.25 ] || fail "node (0, 0)"
[ "$(cell trn.tif 1 2 3)" = -9999 ] || fail "nodata"
grep -q '"cell_size_m": 2.5' trn.json || fail "no cell size in the report"

# known nodata stay apart from the rest: the same bytes as GDAL's own copy
gdal_translate -q -of ENVI -ot Float64 -a_nodata none dem.asc dem.bin
gdal_translate -q -of ENVI -ot Float64 -a_nodata none trn.tif trn.bin
cmp -l dem.bin trn.bin | awk 'END { exit NR > 8 }' || fail "more than the nodata cell differs"

# the same command gives the same bytes, and a terrain is a DEM with the same nodes
expect 0 talus-trn dem.asc -o trn2.tif --crs EPSG:32632
cmp trn.tif trn2.tif || fail "not byte-identical on repeat"
expect 0 talus-trn trn.tif -o trn3.tif --reference dem.asc
prints "RMSE 0 m"
gdal_translate -q -of ENVI -ot Float64 -a_nodata none trn3.tif trn3.bin
cmp trn.bin trn3.bin || fail "a terrain read again differs"

# a window takes the DEM's own nodes, as few as enclose it
expect 0 talus-trn dem.asc -o part.tif --crs EPSG:32632 --window 400004,5000004,400010,5000010
prints "4 x 4 nodes"
[ "$(gdallocationinfo -valonly -geoloc part.tif 400003.75 5000011.25)" = 102.5 ] || fail "window"

# local metres without a place
expect 0 talus-trn dem.asc -o local.tif --crs none
gdalinfo local.tif | grep -q EPSG && fail "local metres got a CRS"
expect 0 talus-trn local.tif -o local2.tif --crs none --reference local.tif
prints "RMSE 0 m"
expect 0 talus-trn dem.asc -o local.tif --crs none --overwrite
expect 1 talus-trn dem.asc -o local.tif --crs none
says "--overwrite"

# reprojecting to the CRS that it has changes nothing
expect 0 talus-trn trn.tif -o same.tif --t-srs EPSG:32632
gdal_translate -q -of ENVI -ot Float64 -a_nodata none same.tif same.bin
cmp trn.bin same.bin || fail "reprojected to its own CRS, the terrain changed"
