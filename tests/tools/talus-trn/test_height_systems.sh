# Heights stay when the plan is reprojected; files that agree in plan are taken.
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
# plane.asc: 41 x 41 cells of 5 m near 11 degrees east, 1 : 2 up to the north
awk 'BEGIN {
  print "ncols 41\nnrows 41\nxllcorner 650000\nyllcorner 5200000\ncellsize 5\nNODATA_value -9999"
  for (r = 0; r < 41; r++) { line = ""; for (c = 0; c < 41; c++) line = line " " 1000 + 2.5 * (40.5 - r); print line }
}' >plane.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 plane.asc utm.tif
gdal_translate -q -ot Float64 -a_srs EPSG:25832+5773 plane.asc egm96.tif
gdal_translate -q -ot Float64 -a_srs EPSG:25832+7837 plane.asc dhhn.tif
height() { gdallocationinfo -valonly "$1" 20 20; }
mean() { gdalinfo -stats "$1" | sed -n 's/.*STATISTICS_MEAN=//p' | head -n 1; }
is_near() { awk -v a="$1" -v b="$2" -v d="$3" 'BEGIN { exit !((a - b) ^ 2 < d ^ 2) }' || fail "$1, expected $2 within $3"; }

# to the same plan: copies, with the heights' system as it was
expect 0 talus-trn egm96.tif -o same.tif --t-srs EPSG:25832 --no-db
is_near "$(height same.tif)" "$(height egm96.tif)" 1e-9
gdalinfo same.tif >info
grep -q "EGM96 height" info || fail "the terrain does not say the system of its heights"
# to another plan: the heights of the plane, 49.7 m less if they were taken for ellipsoidal ones
expect 0 talus-trn egm96.tif -o other.tif --t-srs EPSG:25833 --no-db
is_near "$(mean other.tif)" "$(mean egm96.tif)" 5
gdalinfo other.tif >info
grep -q "EGM96 height" info || fail "the system of heights was lost"
grep -q "UTM zone 33N" info || fail "not in UTM zone 33"

# compared with each other in plan; assumptions are reported
expect 0 talus-trn egm96.tif -o trn.tif --reference utm.tif --no-db
prints "RMSE 0 m"
says "utm.tif and the terrain: both are taken to have heights in EPSG:5773 (EGM96 height)"
expect 0 talus-trn utm.tif -o like.tif --like egm96.tif --no-db
expect 1 talus-trn egm96.tif -o bad.tif --reference dhhn.tif --no-db
says "the heights are in EPSG:7837 (DHHN2016 height), those of the terrain in EPSG:5773 (EGM96 height)"

# heights are not changed by --t-srs, nor given a wrong system
for source in utm.tif dhhn.tif; do
  expect 1 talus-trn $source -o bad.tif --t-srs EPSG:25832+5773 --no-db
  says "would have them in EPSG:5773 (EGM96 height)"
  says "hint: --t-srs EPSG:25832 reprojects in plan, heights stay"
  expect 0 talus-trn $source -o ok.tif --t-srs EPSG:25832 --overwrite --no-db
done
nothing_left bad.tif
expect 0 talus-trn utm.tif -o named.tif --crs EPSG:25832+5773 --no-db
gdalinfo named.tif >info
grep -q "EGM96 height" info || fail "--crs does not name the heights"
expect 1 talus-trn dhhn.tif -o bad.tif --crs EPSG:25832+5773 --no-db
says "leave --crs away"

# points to hold it against, in feet by their system of heights, or by the plan alone
gdal_translate -q -ot Float64 -a_srs EPSG:26912 -a_ullr 450000 4400205 450205 4400000 plane.asc utah.tif
printf 'id,wkt\n1,"POINT Z (450102.5 4400102.5 %s)"\n' "$(awk 'BEGIN { printf "%.9f", 1051.25 * 3937 / 1200 }')" >points.csv
rmse_is() { is_near "$(sed -n 's/.*"rmse_m": \([-0-9.e]*\).*/\1/p' report.json)" "$1" 1e-3; }
ogr2ogr -q in_feet.gpkg points.csv -oo GEOM_POSSIBLE_NAMES=wkt -nlt POINTZ -a_srs EPSG:26912+6360
expect 0 talus-trn utah.tif -o held.tif --reference-points in_feet.gpkg --report report.json --overwrite --no-db
says "in_feet.gpkg: heights in EPSG:6360 (NAVD88 height (ftUS)), taken to metres"
rmse_is 0
ogr2ogr -q plan.gpkg points.csv -oo GEOM_POSSIBLE_NAMES=wkt -nlt POINTZ -s_srs EPSG:26912 -t_srs EPSG:3566
expect 1 talus-trn utah.tif -o bad.tif --reference-points plan.gpkg --no-db
says "plan.gpkg: the plan is in units of 0.3048006096 m, and nothing says what unit the heights are in"
sed -n 's/.*in the file: \(ogr2ogr .*\); in metres: .*/\1/p' err >hint.sh
sh -e hint.sh
expect 0 talus-trn utah.tif -o held.tif --reference-points named.gpkg --report report.json --overwrite --no-db
rmse_is 0
ogr2ogr -q -a_srs EPSG:3566+5703 named_m.gpkg plan.gpkg
expect 0 talus-trn utah.tif -o held.tif --reference-points named_m.gpkg --report report.json --overwrite --no-db
rmse_is 2397.726  # feet taken for metres, as the system says

# heights in feet, by the raster's unit and by its CRS alone: the hint's command makes metres of them
gdal_translate -q -ot Float64 -a_srs EPSG:32632+6360 plane.asc feet.tif
expect 1 talus-trn feet.tif -o bad.tif --no-db
says 'the elevations are in "US survey foot", expected metres'
$(sed -n 's/^ *hint: as "US survey foot": \(.*\); as metres: .*/\1/p' err) -q
expect 0 talus-trn metres.tif -o metres_trn.tif --no-db
is_near "$(height metres_trn.tif)" "$(awk -v z="$(height feet.tif)" 'BEGIN { printf "%.9f", z * 1200 / 3937 }')" 1e-6
rm metres.tif
gdal_translate -q -of VRT feet.tif feet.vrt
sed -i '/<UnitType>/d' feet.vrt
expect 1 talus-trn feet.vrt -o bad.tif --no-db
says "with heights in US survey foot"
$(sed -n 's/^ *hint: //p' err) -q
expect 0 talus-trn metres.tif -o metres_trn.tif --overwrite --no-db
is_near "$(height metres_trn.tif)" "$(awk -v z="$(height feet.tif)" 'BEGIN { printf "%.9f", z * 1200 / 3937 }')" 1e-6

# a failure surface and ground classes in the same plan
command -v talus-blocks >/dev/null || exit 0
gdal_translate -q -ot Float64 -a_srs EPSG:25832 -scale 0 10000 -5 9995 plane.asc surface.tif
cat >site.toml <<'SITE'
[site]
crs = "EPSG:25832"
[source]
polygon = [[650060, 5200060], [650140, 5200060], [650140, 5200140], [650060, 5200140]]
failure_surface = "raster"
raster = "surface.tif"
[joints.rear]
dip_deg = 80
dip_direction_deg = 0
spacing_m = 20
[joints.lateral]
dip_deg = 85
dip_direction_deg = 90
spacing_m = 20
[material.rock]
SITE
expect 0 talus-blocks site.toml --trn trn.tif -o blocks.h5 --no-db
prints "5 m deep on average"
