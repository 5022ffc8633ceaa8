# Contours of a drawing without heights take them from its texts; a drawing without any is refused.
. "$source_dir/tests/tools/talus-tin/map.sh"
drawing() { # drawing N: a plane that rises 1 : 2, contours every 10 m; N of 6 have labels, and one text is a name
  awk -v n="$1" 'BEGIN {
    print "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n0\nENDSEC\n0\nSECTION\n2\nENTITIES"
    for (l = 0; l < 6; ++l) {
      y = 5200000 + 20 * l
      for (half = 0; half < 2; ++half)
        print "0\nLWPOLYLINE\n100\nAcDbEntity\n8\nCONTOURS\n100\nAcDbPolyline\n90\n2\n70\n0\n10\n" 500000 + 106 * half "\n20\n" y "\n10\n" 500094 + 106 * half "\n20\n" y
      if (l < n) print "0\nTEXT\n100\nAcDbEntity\n8\nLABELS\n100\nAcDbText\n10\n500100\n20\n" y - 1 "\n40\n2\n1\n" 800 + 10 * l (l % 2 ? " m" : "") "\n100\nAcDbText"
    }
    print "0\nTEXT\n100\nAcDbEntity\n8\nLABELS\n100\nAcDbText\n10\n500020\n20\n5200050\n40\n2\n1\nAlm\n100\nAcDbText\n0\nENDSEC\n0\nEOF" }'
}
drawing 6 >map.dxf
expect 0 talus-tin 'map.dxf|layername=CONTOURS' --labels 'map.dxf|layername=LABELS' --crs EPSG:32632 -o map.ply
says "map.dxf: 6 labels of heights; 1 other text passed over"
says "elevation from labels of layer CONTOURS"
prints "12 contours, 24 points, every 10 m from 800 to 850 m"
expect 0 talus-trn map.ply -o map.tif --cell-size-m 5
prints "slope 26.6 degrees on average, up to 26.6"
# a drawing of AutoCAD R12 names no classes of its entities
awk '$0 == "100" { getline; next } 1' map.dxf >r12.dxf
expect 0 talus-tin 'r12.dxf|layername=CONTOURS' --labels 'r12.dxf|layername=LABELS' --crs EPSG:32632 -o r12.ply
cmp map.ply r12.ply || fail "the classes of entities make another TIN"
# a point that may part thousands
sed 's/^8\([0-5]0\)\( m\)*$/1.8\1\2/' map.dxf >thousands.dxf
expect 1 talus-tin 'thousands.dxf|layername=CONTOURS' --labels 'thousands.dxf|layername=LABELS' --crs EPSG:32632 -o bad.ply
says 'labels say "1.800", which may be 1.800 m or, with a sign between thousands, 1800 m'
nothing_left bad.ply
drawing 5 >five.dxf
expect 1 talus-tin 'five.dxf|layername=CONTOURS' --labels 'five.dxf|layername=LABELS' --crs EPSG:32632 -o bad.ply
says "2 of 12 contours have no label, the first feature"
says "x 500000, y 5200100"
expect 1 talus-tin 'map.dxf|layername=CONTOURS' --crs EPSG:32632 -o bad.ply
says "have no elevation"
sed 's/^810 m$/8100/' map.dxf >wrong.dxf
expect 1 talus-tin 'wrong.dxf|layername=CONTOURS' --labels 'wrong.dxf|layername=LABELS' --crs EPSG:32632 -o bad.ply
says "the first at 8100 m, feature 3"
nothing_left bad.ply
# texts of a layer of points, in a field of another name
ogr2ogr -q -f GPKG texts.gpkg map.dxf -sql "SELECT Text AS words FROM entities WHERE Layer = 'LABELS'" -nln texts
expect 0 talus-tin 'map.dxf|layername=CONTOURS' --labels texts.gpkg --elevation-field labels=words --crs EPSG:32632 -o again.ply
cmp map.ply again.ply || fail "the same texts give another TIN"
# labels of another system, unit or height than the contours are beside none of them
ogr2ogr -q -a_srs EPSG:32632 placed.gpkg texts.gpkg
ogr2ogr -q -t_srs EPSG:32633 elsewhere.gpkg placed.gpkg
ogr2ogr -q -f GPKG lines.gpkg map.dxf -a_srs EPSG:32632 -sql "SELECT * FROM entities WHERE Layer = 'CONTOURS'" -nln lines
expect 1 talus-tin lines.gpkg --labels elsewhere.gpkg --elevation-field labels=words -o bad.ply
says "the labels are in EPSG:32633"
$(sed -n 's/^ *hint: take them there: //p' err)
expect 0 talus-tin lines.gpkg --labels labels.gpkg --elevation-field labels=words -o back.ply
expect 0 talus-tin lines.gpkg --labels texts.gpkg --elevation-field labels=words -o there.ply
prints "12 contours, 24 points, every 10 m from 800 to 850 m"
for unit in 4 6; do sed "s/^\$ACADVER$/\$INSUNITS\n70\n$unit\n9\n&/" map.dxf >unit$unit.dxf; done
expect 1 talus-tin 'unit6.dxf|layername=CONTOURS' --labels 'unit4.dxf|layername=LABELS' --crs EPSG:32632 -o bad.ply
says "the labels are drawn in millimetres, the contours in metres"
