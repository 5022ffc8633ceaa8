# A finer DEM is averaged, not sampled, when the cell grows: the mean of the 16 cells around a node
# as GDAL computes it, and no trace of a bump that a sample would miss or overstate.
awk 'BEGIN {
  print "ncols 80\nnrows 60\nxllcorner 1000\nyllcorner 2000\ncellsize 2.5\nNODATA_value -9999"
  for (r = 0; r < 60; ++r) {
    line = ""
    for (c = 0; c < 80; ++c) line = line " " 500 + 3 * c + r * r / 20 + 10 * ((7 * r + 3 * c) % 5)
    print line
  }
}' >dem.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32632 dem.asc dem.tif
expect 0 talus-trn dem.tif -o coarse.tif --cell-size-m 10
prints "19 x 14 nodes"   # 1010..1190 by 2010..2140
gdalwarp -q -r average -tr 10 10 -te 1005 2005 1195 2145 dem.tif average.tif
expect 0 talus-trn coarse.tif -o check.tif --reference average.tif --report check.json
awk -F: '/"largest_m"/ { v = $2 + 0; found = 1; exit } END { exit !(found && v < 1e-9 && v > -1e-9) }' check.json ||
  fail "not the mean: $(grep largest_m check.json)"
grep -q '"covered_share": 1.0' check.json || fail "not all nodes compared"

# an unknown cell makes the nodes unknown that it has a share in, and only these
awk 'NR == 36 { $41 = -9999 } { print }' dem.asc >hole.asc
expect 0 talus-trn hole.asc -o hole.tif --crs EPSG:32632 --cell-size-m 10 --report hole.json
known=$(gdal_translate -q -of XYZ hole.tif /vsistdout/ | awk '$3 == -9999' | wc -l)
[ "$known" -eq 1 ] || fail "$known nodes unknown, expected 1"

# a finer cell: bilinear, so that a plane stays the plane
awk 'BEGIN {
  print "ncols 9\nnrows 7\nxllcorner 1000\nyllcorner 2000\ncellsize 5"
  for (r = 0; r < 7; ++r) { line = ""; for (c = 0; c < 9; ++c) line = line " " 100 + 2 * c - r; print line }
}' >plane.asc
expect 0 talus-trn plane.asc -o fine.tif --crs EPSG:32632 --cell-size-m 1
prints "40 x 30 nodes"  # 1003..1042 by 2003..2032
says "the nodes of the DEM are 5 m apart, those of the terrain 1 m"
gdal_translate -q -of ENVI fine.tif fine.bin
od -A n -v -w320 -t f8 fine.bin |
  awk '{ for (c = 1; c <= NF; ++c) {
           e = $c - (100 + 2 * (c - 1 + 0.5) / 5 - (NR - 1 + 0.5) / 5)
           if (e > 1e-9 || e < -1e-9) exit 1 } } END { exit NR != 30 }' || fail "a plane did not stay the plane"
expect 0 talus-trn plane.asc -o own.tif --crs EPSG:32632  # as the warning says
! grep -q "nodes of the DEM" err || fail "the DEM's own cells are called too fine"
