# Goal profile: made from a line of a file, made again when the line is another one, taken away by clean.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
expect 2 make -C slope BIN= profile
says 'profile needs LINE, a file with one line'
expect 2 make -C slope BIN= profile LINE=none.geojson
says 'LINE is none.geojson: there is no such file'
expect 2 make -C slope BIN= profile 'LINE=a b.geojson'
says 'expected the name of one file without blanks'
# across the source, where blocks move first
made slope RUNS=2 runs
draw() {
  ogr2ogr -overwrite slope/line.gpkg slope/out/blocks.gpkg -nln line -dialect SQLite -sql "SELECT MakeLine(
    MakePoint(ST_MinX(e) $1, ST_MinY(e), ST_SRID(e)), MakePoint(ST_MaxX(e) $1, ST_MaxY(e), ST_SRID(e))) AS geom
    FROM (SELECT ST_Envelope(ST_Collect(geom)) AS e FROM blocks)"
}
draw '+ 0'
made slope RUNS=2 profile LINE=line.gpkg
prints 'by frames'
for file in profile.gpkg profile.json crossings.csv bins.csv stations.csv ground.svg count.svg energy.svg speed.svg height.svg; do
  [ -f "slope/out/profile/$file" ] || fail "no $file"
done
on_page slope/out/profile/profile.gpkg slope/out/profile/crossings.csv slope/out/profile/bins.csv \
  slope/out/profile/stations.csv
cp slope/out/profile/stations.csv first.csv
made slope RUNS=2 profile LINE=line.gpkg
prints 'Nothing to be done'
draw '+ 5'
made slope RUNS=2 profile LINE=line.gpkg
if cmp -s first.csv slope/out/profile/stations.csv; then fail 'another line, the same profile'; fi
made slope RUNS=2 profile LINE=line.gpkg PROFILE_FLAGS='--step-m 50'
[ "$(wc -l <slope/out/profile/stations.csv)" -lt "$(wc -l <first.csv)" ] || fail 'PROFILE_FLAGS do not count'
made slope clean
[ ! -e slope/out ] || fail "left: $(find slope/out)"
