# Surfaces that CAD has as triangles become terrain: faces of drawings, LandXML, PLY as text.
command -v gdalinfo >/dev/null || skip "needs gdal-bin"
# 1000 + 0.5 (y - 5200000) on 8 x 8 squares of 25 m, each cut along a diagonal
awk 'BEGIN {
  print "0\nSECTION\n2\nENTITIES" >"faces.dxf"
  print "<?xml version=\"1.0\"?><LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\"><Units><Metric linearUnit=\"meter\"/></Units><CoordinateSystem epsgCode=\"25832\"/><Surfaces><Surface name=\"G\"><Definition surfType=\"TIN\"><Pnts>" >"ground.xml"
  print "ply\nformat ascii 1.0\nelement vertex 81\nproperty double x\nproperty double y\nproperty double z\nelement face 128\nproperty list uchar int vertex_indices\nend_header" >"ground.ply"
  for (j = 0; j < 9; ++j) for (i = 0; i < 9; ++i) {
    x[9*j+i] = 650000 + 25*i; y[9*j+i] = 5200000 + 25*j; z[9*j+i] = 1000 + 12.5*j; k = 9*j+i
    printf "%d %d %.1f\n", x[k], y[k], z[k] >"ground.ply"
    printf "<P id=\"%d\">%d %d %.1f</P>\n", k + 1, y[k], x[k], z[k] >"ground.xml" }
  print "</Pnts><Faces>" >"ground.xml"
  for (j = 0; j < 8; ++j) for (i = 0; i < 8; ++i) { a = 9*j+i; face(a, a+1, a+10); face(a, a+10, a+9) }
  print "</Faces></Definition></Surface></Surfaces></LandXML>" >"ground.xml"
  print "0\nENDSEC\n0\nEOF" >"faces.dxf" }
  function face(a, b, c) {
    print "0\n3DFACE\n8\nTIN\n10\n" x[a] "\n20\n" y[a] "\n30\n" z[a] "\n11\n" x[b] "\n21\n" y[b] "\n31\n" z[b] "\n12\n" x[c] "\n22\n" y[c] "\n32\n" z[c] "\n13\n" x[c] "\n23\n" y[c] "\n33\n" z[c] >"faces.dxf"
    print "<F>" a+1, b+1, c+1 "</F>" >"ground.xml"; print 3, a, b, c >"ground.ply" }' OFMT=%.1f CONVFMT=%.1f
for source in faces.dxf ground.xml ground.ply; do
  crs="--crs EPSG:25832"
  [ $source != ground.xml ] || crs=
  expect 0 talus-trn $source -o $source.tif --cell-size-m 5 $crs
  prints "41 x 41 nodes, 5 m apart, 100 % known, 1000 to 1100 m"
  prints "slope 26.6 degrees on average, up to 26.6"
  gdalinfo $source.tif | grep -q 'ID\["EPSG",25832\]' || fail "no CRS of $source"
  gdal_translate -q -of ENVI $source.tif $source.bin
done
for source in ground.xml ground.ply; do cmp faces.dxf.bin $source.bin || fail "$source is another terrain"; done
expect 1 talus-tin faces.dxf --crs EPSG:25832 -o bad.ply
says "hint: a surface of faces needs no contours: talus-trn faces.dxf -o terrain.tif --crs EPSG:code"
$(sed -n 's/^ *hint: a surface of faces needs no contours: //p' err | sed 's/EPSG:code/EPSG:25832/')

# a second layer of faces over the ground has two heights in one place
sed 's/^ENTITIES$/&\n0\n3DFACE\n8\nroof\n10\n650000\n20\n5200000\n30\n1000\n11\n650025\n21\n5200000\n31\n1000\n12\n650025\n22\n5200050\n32\n1099\n13\n650025\n23\n5200050\n33\n1099/' faces.dxf >roof.dxf
expect 1 talus-trn roof.dxf -o bad.tif --crs EPSG:25832
says "2 layers of the drawing hold faces, expected one; they are: TIN (128), roof (1)"
expect 0 talus-trn 'roof.dxf|layername=TIN' -o ground.tif --cell-size-m 5 --crs EPSG:25832
gdal_translate -q -of ENVI ground.tif ground.bin
cmp ground.bin faces.dxf.bin || fail "the layer of the ground is another terrain"
expect 1 talus-trn 'roof.dxf|layername=*' -o bad.tif --crs EPSG:25832
says "the surface folds over or has two layers at 1 edge"
expect 0 talus-trn 'roof.dxf|layername=TIN,roof' -o roof.tif --crs EPSG:25832 --accept-doubts
says "warning: roof.dxf|layername=TIN,roof: second layer"
# a drawing in feet is refused; the hint's option scales plan and heights
{ printf '0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n2\n0\nENDSEC\n'; cat faces.dxf; } >feet.dxf
expect 1 talus-trn feet.dxf -o bad.tif --crs none
says "as feet: --unit-m 0.3048, for plan and heights"
expect 0 talus-trn feet.dxf -o feet.tif --crs none --unit-m 0.3048
prints "304.8 to 334.8 m"  # 1000 ft, and 1 : 2 over 60 m
expect 2 talus-trn faces.dxf.tif -o bad.tif --unit-m 2
sed 's/linearUnit="meter"/linearUnit="foot"/' ground.xml >feet.xml
expect 1 talus-trn feet.xml -o bad.tif
says "linearUnit is foot, expected meter"
sed '$d' ground.ply >short.ply
expect 1 talus-trn short.ply -o bad.tif --crs EPSG:25832
says "short.ply:218: the file ends early"
nothing_left bad.tif bad.ply
