# Each hint that holds a command is obeyed, and the terrain that follows is the ground: a plane that
# rises 1 : 2 to the north, from 20 m on, where a rim of zeros would pass for ground.
{
  printf 'ncols 41\nnrows 41\nxllcorner 650000\nyllcorner 5200000\ncellsize 5\n'
  awk 'BEGIN { for (r = 40; r >= 0; --r) { for (c = 0; c < 41; ++c) printf "%.3f ", 20 + 2.5 * (r + 0.5); print "" } }'
} >plane.asc
gdal_translate -q -a_srs EPSG:25832 plane.asc plane.tif

# obey: run the command after the last hint of standard error
obey() {
  command=$(sed -n 's/.*hint: //p' err | tail -n 1 | sed 's/.*\(gdalwarp\|gdal_translate\)/\1/; s/ makes metres.*//')
  case $command in
    gdalwarp*|gdal_translate*) sh -c "$command" >/dev/null || fail "the command of the hint fails: $command" ;;
    *) fail "no command in the hint: $(cat err)" ;;
  esac
}
# is_plane FILE: heights of 20 m and more, slope 26.6 degrees throughout
is_plane() {
  expect 0 talus-trn "$1" -o t.tif --report t.json --no-db --overwrite ${2:-}
  python3 - <<'END' || fail "$1 is another ground: $(cat out)"
import json
t = json.load(open("t.json"))
assert abs(t["slope"]["mean_deg"] - 26.565) < 0.3 and t["slope"]["largest_deg"] < 28, t["slope"]
assert t["grid"]["lowest_m"] > 20 and t["grid"]["highest_m"] < 126, t["grid"]
END
}
command -v python3 >/dev/null || skip "needs python3"

gdal_translate -q -a_srs EPSG:25832 -a_ullr 650000 5200205 650205 5199959 plane.asc oblong.tif
expect 1 talus-trn oblong.tif -o t.tif --no-db --overwrite
says "expected squares"
obey
gdalinfo north_up.tif | grep -q 'NoData Value=nan' || fail "what is outside is not unknown"

gdal_translate -q -of VRT plane.tif rotated.vrt
sed -i 's#<GeoTransform>.*</GeoTransform>#<GeoTransform>650000,4.924,0.868,5200205,0.868,-4.924</GeoTransform>#' rotated.vrt
expect 1 talus-trn rotated.vrt -o t.tif --no-db --overwrite
says "rotated" "-tr 5"
rm -f north_up.tif
obey
is_plane north_up.tif

gdalwarp -q -t_srs EPSG:4326 -r bilinear -ot Float32 -dstnodata nan plane.tif degrees.tif
expect 1 talus-trn degrees.tif -o t.tif --no-db --overwrite
says "in degrees"
obey
expect 0 talus-trn projected.tif -o t.tif --no-db --overwrite -q

gdal_translate -q -a_srs EPSG:25832 -gcp 0 0 650000 5200205 -gcp 41 0 650205 5200205 -gcp 41 41 650205 5200000 -gcp 0 41 650000 5200000 plane.asc points.tif
expect 1 talus-trn points.tif -o t.tif --no-db --overwrite
says "ground control points"
obey
is_plane placed.tif "--crs EPSG:25832"

for unit in "dm 0.1" "cm 0.01" "mm 0.001" "ft 0.3048"; do
  name=${unit% *} size=${unit#* }
  gdal_translate -q -of VRT -ot Float64 -scale 0 1 0 "$(awk "BEGIN { print 1 / $size }")" plane.tif $name.vrt
  sed -i "s#<ColorInterp>#<UnitType>$name</UnitType><ColorInterp>#" $name.vrt
  expect 1 talus-trn $name.vrt -o t.tif --no-db --overwrite
  says "\"$name\""
  rm -f metres.tif
  obey
  is_plane metres.tif
done
for word in "m a.s.l." metros unspecified; do
  gdal_translate -q -of VRT plane.tif word.vrt
  sed -i "s#<ColorInterp>#<UnitType>$word</UnitType><ColorInterp>#" word.vrt
  is_plane word.vrt
done

# most cells above every summit: centimetres
gdal_translate -q -ot Int32 -scale 0 100 200000 210000 plane.tif cm.tif
expect 1 talus-trn cm.tif -o t.tif --no-db --overwrite
says "as centimetres they would be"
rm -f metres.tif
obey
expect 0 talus-trn metres.tif -o t.tif --no-db --overwrite -q

# a local system in feet
gdal_translate -q -ot Float64 -scale 0 0.3048 0 1 -a_ullr 0 672.57 672.57 0 -a_srs 'LOCAL_CS["site",UNIT["foot",0.3048]]' plane.asc local.tif
expect 1 talus-trn local.tif -o t.tif --no-db --overwrite
says "then --crs none"
rm -f metres.tif
obey
is_plane metres.tif "--crs none"

# an extent in the order of QGIS
expect 1 talus-trn plane.tif -o t.tif --no-db --overwrite --window 650050,650150,5200050,5200150
says "--window 650050,5200050,650150,5200150"
expect 0 talus-trn plane.tif -o t.tif --no-db --overwrite --window 650050,5200050,650150,5200150

# a picture, tiles, an archive
gdal_translate -q -ot Byte -b 1 -b 1 -b 1 -colorinterp red,green,blue plane.tif rgb.tif
expect 1 talus-trn rgb.tif -o t.tif --no-db --overwrite
says "colours of a picture"
expect 2 talus-trn plane.tif oblong.tif -o t.tif --no-db --overwrite
says "gdalbuildvrt"
mkdir tiles && cp plane.tif tiles
expect 1 talus-trn tiles -o t.tif --no-db --overwrite
says "gdalbuildvrt"
python3 -c "import zipfile; z = zipfile.ZipFile('dem.zip', 'w'); z.write('plane.tif'); z.close()"
is_plane dem.zip
# a seam
gdal_translate -q -srcwin 0 0 20 41 -ot Float32 -scale 0 1 7 8 plane.tif west.tif
gdal_translate -q -srcwin 20 0 21 41 plane.tif east.tif
gdalbuildvrt -q seam.vrt west.tif east.tif
expect 0 talus-trn seam.vrt -o t.tif --no-db --overwrite
says "seam"
