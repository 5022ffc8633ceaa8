# Undeclared nodata in rims, gaps and cells are refused, and the hint's command mends it.
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
grid() { # grid CONDITION VALUE: a slope from 1000 to 1100 m; cells where the condition holds get VALUE
  awk -v value="$2" 'BEGIN {
    print "ncols 41\nnrows 41\nxllcorner 650000\nyllcorner 5200000\ncellsize 5"
    for (r = 0; r < 41; r++) {
      line = ""
      for (c = 0; c < 41; c++) line = line " " ('"$1"' ? value : 1000 + 2.5 * (40.5 - r))
      print line
    }
  }' >grid.asc
  gdal_translate -q -ot Float32 -a_srs EPSG:25832 grid.asc grid.tif
}
refused() { # refused VALUE CELLS
  rm -f declared.tif
  expect 1 talus-trn grid.tif -o bad.tif --no-db
  says "the elevation is $1 m in $2 side by side"
  says "hint: if it stands for nodata: gdal_translate -a_nodata $1 grid.tif declared.tif"
  nothing_left bad.tif
  $(sed -n 's/^ *hint: if it stands for nodata: //p' err) -q
  expect 0 talus-trn declared.tif -o good.tif --overwrite --no-db
}
for value in 0 -999 -1 255; do
  grid 'r < 6 || c < 8' $value
  refused $value "526 cells"
  prints "68.7 % known, 1001.25 to 1086.25 m"
done
grid 'r < 6 || c < 8' 9999 # above every summit
expect 1 talus-trn grid.tif -o bad.tif --no-db
says "the elevation is 9999 m, which the file does not declare as nodata"
grid 'c == 20 || c == 21' 0
refused 0 "82 cells"
grid 'r == 12 && c == 30' 3000
refused 3000 "1 cell"

# also where the raster is reprojected, and where a window of it is taken
grid 'r < 6 || c < 8' 0
expect 1 talus-trn grid.tif -o bad.tif --no-db --t-srs EPSG:25833
says "the elevation is 0 m in"
expect 1 talus-trn grid.tif -o bad.tif --no-db --window 650000,5200000,650100,5200100
expect 0 talus-trn grid.tif -o good.tif --overwrite --no-db --window 650050,5200000,650200,5200170

# a cliff and a level below it are ground
grid 'r > 30' 900
expect 0 talus-trn grid.tif -o good.tif --overwrite --no-db

# taken as ground only when that is asked for, which the terrain says to those who read it
grid 'r < 6 || c < 8' 0
expect 1 talus-trn grid.tif -o bad.tif --no-db
says "(talus-trn --accept-doubts takes it as ground, make TRN_FLAGS=--accept-doubts)"
expect 0 talus-trn grid.tif -o accepted.tif --no-db --accept-doubts --report accepted.json
grep -q '"accepted_places": "level area' accepted.json || fail "the report does not say it"
gdalinfo accepted.tif | grep -q 'DOUBTS_ACCEPTED=level area at 0 m, x 650002.5, y 5200202.5' || fail "the terrain does not say it"
expect 0 talus-trn accepted.tif -o again.tif --no-db
! gdalinfo good.tif | grep -q DOUBTS || fail "a sound terrain says it"

# a rim blended with nodata, a level area 60 m off: warned of, all places in a layer
grid 0 0
awk 'NR > 5 { $1 = 500 + 7 * (NR % 9) } 1' grid.asc >rim.asc
gdal_translate -q -ot Float32 -a_srs EPSG:25832 rim.asc rim.tif
expect 0 talus-trn rim.tif -o rim.trn.tif --no-db --doubts rim.gpkg --report rim.json
says "warning: rim.tif: 41 rim nodes, the first at"
grep -q '"rim node": 41' rim.json || fail "$(grep -A3 n_doubts rim.json)"
[ "$(ogrinfo -so -where "what = 'rim node'" rim.gpkg doubts | grep 'Feature Count')" = "Feature Count: 41" ] || fail "41 places expected"
grid 'r > 10 && r < 14 && c > 10 && c < 14' 1000
expect 0 talus-trn grid.tif -o level.tif --no-db
says "warning: grid.tif: level area at 1000 m"
grid 'r > 10 && c > 10' -510
expect 1 talus-trn grid.tif -o bad.tif --no-db
awk 'NR > 5 { for (c = 1; c <= NF; ++c) $c -= 1600 } 1' rim.asc >deep.asc
gdal_translate -q -ot Float32 -a_srs EPSG:25832 deep.asc deep.tif
expect 1 talus-trn deep.tif -o bad.tif --no-db --doubts deep.gpkg
says "sunken nodes, the first at"
says "lower than any land; expected -500 m or more"
nothing_left bad.tif
[ -f deep.gpkg ] || fail "no places of what was refused"
expect 0 talus-trn deep.tif -o deep.trn.tif --no-db --accept-doubts
