# A site of rocks one by one: from a ground and a polygon, and from a folder as of Rockyfor3D, to classes.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
new() { sh "$source_dir/pipelines/new_site.sh" "$@"; }
# 40 x 60 cells of 4 m: 45 degrees in the north, from there on 14 degrees
awk 'BEGIN { print "ncols 40\nnrows 60\nxllcorner 650000\nyllcorner 5200000\ncellsize 4\nNODATA_value -9999"
  for (r = 0; r < 60; r++) { y = 4 * (59 - r); z = 500 + 0.25 * y + (y > 160 ? 0.75 * (y - 160) : 0)
    for (c = 0; c < 40; c++) printf "%g ", z; print "" } }' >dem.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 dem.asc dem.tif
cat >cliff.geojson <<'END'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
 "features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon",
 "coordinates": [[[650060, 5200120], [650100, 5200120], [650100, 5200220], [650060, 5200220], [650060, 5200120]]]}}]}
END
expect 0 new wall dem.tif cliff.geojson "$source_dir/pipelines" "" yes
prints "edit $work/wall/site.toml (rocks, soils)"
expect 0 make -C wall BIN= blocks
says 'of the ground of its areas is 40 deg steep or more'
# a path below the wall, and how often: the goal computes ten runs of different rocks, maps, classes and the report
cat >>wall/site.toml <<'END'
[object.road]
line = [[650020, 5200100], [650140, 5200100]]
width_m = 6
[hazard.class.rocks]
END
sed -i -e 's/^# frequency_per_a = 0.5/frequency_per_a = 0.5/' -e 's/^duration_s = 120/duration_s = 30/' \
  -e 's/^rocks = 1/release_spacing_m = 12\n&/' \
  -e 's/^soil = .*/friction_deg = 38\ncor = 0.9\ncor_half_speed_m_s = 15\nrolling_resistance = 0.08/' wall/site.toml
made wall -j2
[ "$(ls wall/out/runs/run_*.h5 | wc -l)" -eq 10 ] || fail 'not ten runs'
prints 'run_10: 23 rocks'
python3 - <<'PY' || fail 'runs, hits and classes'
import json
hazard, trace = (json.load(open(f'wall/out/{name}.json')) for name in ('hazard', 'trace'))
kind, = hazard['frequencies']
assert abs(kind['frequency_per_a'] - 0.5) < 1e-9 and kind['event'] == 'rock', kind
assert trace['objects'][0]['name'] == 'road'
PY
# many of these rocks leave the terrain: no run fails, and the report begins with their share
grep -q '% of the blocks left the known terrain' wall/out/report.html || fail 'lost rocks are not on the page'
n_lost=$(ogrinfo -q -ro wall/out/runout.gpkg -sql "SELECT count(*) n FROM deposit WHERE fate = 'left_domain'" | sed -n 's/.*n (Integer) = //p')
python3 -c "import json; assert json.load(open('wall/out/runout.json'))['balance']['n_left_domain'] == $n_lost > 20" ||
  fail 'not each lost rock has a place'
cmp -s wall/out/rock/blocks_1.h5 wall/out/rock/blocks_2.h5 && fail 'two runs have the same rocks'

# Intervals are made over release cells: one run has them. Runs are added until they are narrow
# enough, each with rocks of its own in other cells, or until more rocks of all cells do not help.
cat >>wall/site.toml <<'END'
[place.below]
polygon = [[650060, 5200060], [650100, 5200060], [650100, 5200100], [650060, 5200100]]
half_width = 0.2
END
sed -i 's/^duration_s = 30/&\nn_runs = 1/' wall/site.toml
made wall RUNS=1 places maps
prints 'intervals are made over 23 release cells'
gdalinfo wall/out/maps/reach.tif | grep -q 'INTERVALS_OVER=23 release cells' || fail 'maps do not say what intervals are over'
reach() { # reach CONDITION: of the place, with its share s, half width h and number of runs n
  python3 - "$1" <<'PY' || fail "the place: $1"
import json, sys
places = json.load(open('wall/out/places.json'))
place, = places['places']
s, h, n = place['share_of_blocks'], place['half_width'], places['n_runs']
assert places['intervals_over'].endswith(' release cells') and eval(sys.argv[1]), places
PY
}
reach 'n == 1 and 0.5 < s < 0.95 and 0.1 < h < 0.2'
sed -i 's/^half_width = .*/half_width = 0.13/' wall/site.toml
made wall -j2 WITHOUT=no RUNS=auto places
says 'runs are enough, intervals over'
reach '1 < n < 64 and h <= 0.13'
sed -i 's/^half_width = .*/half_width = 0.02/' wall/site.toml
made wall -j2 WITHOUT=no RUNS=auto places
says 'and more runs do not help'
expect 2 make -C wall BIN= RUNS=auto BLOCKS_FLAGS=-v places
says 'without BLOCKS_FLAGS'

# the folder: the same ground, five cells of the wall
mkdir folder
cp dem.asc folder
cells() { # cells NAME VALUE ELSEWHERE: five cells in the wall have the value
  awk -v v="$2" -v other="$3" 'NR <= 6 { print; next }
    { for (c = 1; c <= NF; c++) printf "%g ", (NR == 16 && c > 15 && c < 21 ? v : other); print "" }' dem.asc >"folder/$1.asc"
}
cells rockdensity 2700 0
for d in d1 d2 d3; do cells $d 0.8 0; done
cells blshape 1 0
cells soiltype 6 3
cells rg70 0.1 0.1
cells nrtrees 0 200
cells dbhmean 25 25
echo x >folder/net.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 folder/dem.asc crs.tif
gdalsrsinfo -o wkt_esri EPSG:25832 | sed '/^$/d' >folder/dem.prj
expect 2 new cells folder "" "$source_dir/pipelines" "" no
says 'ROCKFALL is no, expected yes'
expect 1 new cells folder "" "$source_dir/pipelines"
says 'a folder of Rockyfor3D needs ROCKFALL=yes'
expect 0 new cells folder "" "$source_dir/pipelines" "" yes
says 'not taken over: rg70.asc' 
says 'not taken over: net.asc: unknown'
for words in 'density_kg_m3 = 2700' 'soil = "rock"' 'raster_values = \[6\]' 'soil = "scree"' 'nrtrees_raster = '; do
  grep -q "^$words" cells/site.toml || fail "the site has no $words"
done
expect 0 make -C cells BIN= blocks
prints '5 blocks, 2.56 m3'
nothing_left other
