# A report that is called by hand leaves out hazard classes, traces and places that were made with
# other sections of the site file, or with other files that these name, and says so.
run-probe . 3 objects=watched
mkdir -p results/runs
mv run_*.h5 results/runs/
cp slope.tif results/trn.tif
cat >school.geojson <<'END'
{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:31254"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[250010,350000],[250040,350000],[250040,350020],[250010,350020],[250010,350000]]]}}]}
END
printf '\n[hazard.class.all]\nfrequency_per_a = 0.01\n[place.school]\npolygon_file = "school.geojson"\n' >>site.toml
expect 0 talus-runout results/runs/*.h5 --trn results/trn.tif -o results/runout.gpkg --json results/runout.json --no-db
expect 0 talus-hazard site.toml results/runs/*.h5 --trn results/trn.tif -o results/hazard --json results/hazard.json --no-db
expect 0 talus-trace site.toml results/runs/*.h5 --trn results/trn.tif -o results/trace.gpkg --json results/trace.json --no-db
expect 0 talus-places site.toml results/runs/*.h5 --trn results/trn.tif --json results/places.json --no-db
report() { expect 0 talus-report "$1" --dir results -o report.html --no-db --overwrite; }
left_out() { grep -qF "$1" err || { cat err >&2; fail "$1 is not left out"; }; }
all_there() { ! grep -q 'made with other' err || { cat err >&2; fail 'a result of the same site file is left out'; }; }
report site.toml
all_there
sed 's/frequency_per_a = 0.01/frequency_per_a = 0.02/' site.toml >frequency.toml
report frequency.toml
left_out 'hazard.json'
left_out 'made with other [hazard*] than the site file has'
left_out 'made with other [object.*] or [hazard*] than the site file has'
grep -q 'places.json' err && fail 'places do not depend on frequencies'
sed 's/radius_m = 1.5/radius_m = 2.5/' site.toml >object.toml
expect 1 talus-report object.toml --dir results -o report.html --no-db --overwrite  # runs watched it
says 'was computed with other settings than the site file has: object.hut.radius_m: 1.5, there 2.5'
# the bytes of a file that a section names, not its name
sed -i 's/250010/250012/g' school.geojson
report site.toml
left_out 'made with other [place.*] or [fence.*] than the site file has'
sed -i 's/250012/250010/g' school.geojson
report site.toml
all_there

# curves of other runs, by their ids
printf 'run_id,time_s\n0123456789abcdef,0\n' >results/curves.csv
report site.toml
left_out 'curves.csv: not of the runs that runout.json is of'
rm results/curves.csv

# all files of a Shapefile, and the content of an archive
if command -v ogr2ogr >/dev/null && command -v python3 >/dev/null; then
  sed -e 's/"properties":{}/"properties":{"kind":"school"}/' school.geojson >kind.geojson
  ogr2ogr -q -f "ESRI Shapefile" school.shp kind.geojson
  sed -e 's/"school"/"stable"/' kind.geojson >stable.geojson
  ogr2ogr -q -f "ESRI Shapefile" stable.shp stable.geojson
  zip() { python3 -c "import zipfile; zipfile.ZipFile('map.zip', 'w').write('kind.geojson')"; }
  zip
  for file in school.shp map.zip/kind.geojson; do
    sed "s#^polygon_file = \"school.geojson\"#polygon_file = \"$file\"#" site.toml >other.toml
    expect 0 talus-places other.toml results/runs/*.h5 --trn results/trn.tif --json results/places.json --overwrite --no-db
    report other.toml
    all_there
    cp stable.dbf school.dbf
    sed -i 's/"kind":"/"kind":"x/' kind.geojson
    zip
    report other.toml
    left_out 'places.json'
  done
fi
