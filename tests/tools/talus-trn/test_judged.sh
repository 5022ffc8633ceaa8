# Heights that one tool has judged, and the user accepted, are not judged again: neither of files
# made from it nor of copies; heights that were changed since are judged.
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
# A slope down to the south with a pit of four cells 700 m below it
awk 'BEGIN {
  print "ncols 41\nnrows 41\nxllcorner 650000\nyllcorner 5200000\ncellsize 5"
  for (r = 0; r < 41; r++) {
    line = ""
    for (c = 0; c < 41; c++) line = line " " ((r == 30 || r == 31) && (c == 4 || c == 5) ? 300 : 1000 + 2.5 * (40.5 - r))
    print line
  } }' >dem.asc
expect 1 talus-trn dem.asc -o t.tif --crs EPSG:32632 --no-db
says "make TRN_FLAGS=--accept-doubts"
expect 0 talus-trn dem.asc -o t.tif --crs EPSG:32632 --accept-doubts --no-db --report t.json
pit='level area at 300 m, x 650022.5, y 5200052.5'
grep -qF "\"accepted_places\": \"$pit" t.json || fail "the report does not say where: $(cat t.json)"
accepted() { gdalinfo "$1" | grep -qF "DOUBTS_ACCEPTED=$pit" || fail "$1 does not say where"; }
accepted t.tif

# the terrain again: a part, other cells, another system
for options in '--window 650000,5200000,650100,5200100' '--cell-size-m 4' '--t-srs EPSG:32633' "--like dem.asc"; do
  expect 0 talus-trn t.tif -o part.tif $options --no-db --overwrite
  accepted part.tif
  expect 0 talus-trn part.tif -o again.tif --no-db --overwrite
  accepted again.tif
done

# its bed, the run on it, and the look before
cat >site.toml <<'END'
[site]
name = "t"
crs = "EPSG:32632"
[source]
polygon = [[650100, 5200100], [650140, 5200100], [650140, 5200140], [650100, 5200140]]
failure_surface = "vertical_depth"
depth_m = 5
[joints.a]
dip_deg = 80
dip_direction_deg = 90
spacing_m = 10
[material.rock]
density_kg_m3 = 2600
[solver]
duration_s = 0.1
END
expect 0 talus-blocks site.toml --trn t.tif -o blocks.h5 --trn-out bed.tif --report blocks.json --no-db
accepted bed.tif
grep -qF "\"accepted_places\": \"$pit" blocks.json || fail "blocks.json does not say where"
expect 0 talus-source site.toml --trn t.tif -o planes.json --no-db
expect 0 talus-dda site.toml --trn bed.tif --blocks blocks.h5 -o run.h5 --no-db
says "heights of the terrain that were accepted: $pit"
expect 0 talus-check site.toml --trn t.tif --bed bed.tif --blocks blocks.h5 -o check.html --probe-s 0 --no-db --accept-doubts
expect 0 talus-maps run.h5 --trn bed.tif -o maps --no-db

# each rock mass has a ground of its own
printf '[uncertainty]\nrock_masses = 3\nterrain_rmse_m = 0.5\n' >>site.toml
expect 0 talus-blocks site.toml --trn t.tif -o mass.h5 --trn-out mass.tif --sample 2 --no-db
accepted mass.tif
expect 0 talus-dda site.toml --trn mass.tif --blocks mass.h5 -o mass_run.h5 --sample 2 --no-db

# other programs: a copy has the same heights; a part, other heights and a claim alone have not
blocks() { talus-blocks site.toml --trn "$1" -o other.h5 --no-db --overwrite; }
gdal_translate -q -co COMPRESS=LZW -co TILED=NO t.tif copy.tif
expect 0 blocks copy.tif
gdal_translate -q -of VRT t.tif copy.vrt
expect 0 blocks copy.vrt
gdal_translate -q -srcwin 0 0 40 41 t.tif window.tif
gdal_translate -q -ot Float32 t.tif rounded.tif
gdal_translate -q -scale 0 1000 0 1001 t.tif higher.tif
gdal_translate -q -a_scale 1.1 t.tif scaled.tif
gdal_translate -q -a_offset 1 t.tif offset.tif
gdal_translate -q -a_ullr 650000 5200205 650205 5199980 t.tif oblong.tif
gdal_translate -q -a_srs EPSG:32632 -mo DOUBTS_ACCEPTED=YES -mo "$(gdalinfo t.tif | grep -o 'HEIGHTS_JUDGED=.*')" dem.asc claim.tif
for file in window rounded higher scaled offset oblong claim; do
  expect 1 blocks $file.tif
  [ $file = oblong ] || says "side by side, more than 200 m off"
done

# a surface of another program: a step that talus-trn warns of stops nobody behind it
python3 - <<'PY'
with open('wall.xml', 'w') as f:
    f.write('<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2"><Units><Metric linearUnit="meter"/></Units><Surfaces><Surface name="G"><Definition surfType="TIN"><Pnts>')
    n = 21
    for j in range(n):
        for i in range(n):
            z = 1000 + 5 * j - (400 if i in (3, 4) and j in (3, 4) else 0)
            f.write(f'<P id="{j * n + i + 1}">{5200000 + 10 * j} {650000 + 10 * i} {z}</P>')
    f.write('</Pnts><Faces>')
    for j in range(n - 1):
        for i in range(n - 1):
            a = j * n + i + 1
            f.write(f'<F>{a} {a + 1} {a + n + 1}</F><F>{a} {a + n + 1} {a + n}</F>')
    f.write('</Faces></Definition></Surface></Surfaces></LandXML>')
PY
expect 0 talus-trn wall.xml -o wall.tif --crs EPSG:32632 --cell-size-m 10 --no-db
says "warning: wall.xml: 2 level areas"
expect 0 talus-blocks site.toml --trn wall.tif -o wall.h5 --trn-out wall_bed.tif --no-db
expect 0 talus-dda site.toml --trn wall_bed.tif --blocks wall.h5 -o wall_run.h5 --no-db

# points far below the sea, accepted by talus-tin: neither talus-trn nor another cell size asks again
awk 'BEGIN { print "x,y,z"; for (j = 0; j < 9; j++) for (i = 0; i < 9; i++) printf "%d,%d,%d\n", 650000 + 10 * i, 5200000 + 10 * j, 5 * j - 700 }' >sea.csv
expect 1 talus-tin sea.csv --points -o sea.ply --crs EPSG:32632 --no-db
says "make TIN_FLAGS=--accept-doubts"
expect 0 talus-tin sea.csv --points -o sea.ply --crs EPSG:32632 --accept-doubts --no-db
expect 0 talus-trn sea.ply -o sea.tif --no-db
gdalinfo sea.tif | grep -q 'DOUBTS_ACCEPTED=point at -700 m, x 650000, y 5200000; .* 61 more' || fail "$(gdalinfo sea.tif)"
expect 0 talus-trn sea.tif -o sea_fine.tif --cell-size-m 5 --no-db
# edited in between, the points are judged again
python3 - <<'PY'
data = bytearray(open('sea.ply', 'rb').read())
data[data.find(b'end_header\n') + 11 + 20] ^= 1
open('edited.ply', 'wb').write(data)
PY
expect 1 talus-trn edited.ply -o edited.tif --no-db
says "lower than any land"
nothing_left edited.tif
