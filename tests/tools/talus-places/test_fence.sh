# A place that is the line of a fence: the runs must have watched the line where it is now.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
printf '[place.road]\nfence = "low"\n' >>site.toml
expect 0 run_dda -o run.h5
places() { talus-places "$1" run.h5 --trn slope.tif --json places.json --overwrite --no-db; }
expect 0 places site.toml
prints "road: 100 % of the blocks"
sed 's/500060/500140/g' site.toml >moved.toml
expect 1 places moved.toml
says "run.h5: recorded another line for fence low than moved.toml"
# named by a file whose line was moved
cat >line.geojson <<'END'
{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[500060,5000010],[500060,5000090]]}}]}
END
sed 's/^line = .*/file = "line.geojson"/' site.toml >file.toml
expect 0 places file.toml
prints "road: 100 % of the blocks"
sed -i 's/500060/500061/g' line.geojson
expect 1 places file.toml
says "run.h5: recorded another line for fence low than file.toml"
sed -e 's/fence.low/fence.high/' -e 's/fence = "low"/fence = "high"/' site.toml >other.toml
expect 1 places other.toml
says "run.h5: recorded no line for fence high"
