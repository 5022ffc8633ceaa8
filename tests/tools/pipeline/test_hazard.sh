# Goals hazard and trace: their parts of the report and of the project; clean takes all of it away.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
made slope RUNS=2 hazard
grep -q 'no frequency is given' err || fail 'hazard without frequencies does not say why there are no classes'
[ -f slope/out/hazard/event_exceed.tif ] && [ ! -e slope/out/hazard/class.tif ] || fail 'classes without frequencies'
cat >>slope/site.toml <<'TOML'

[object.road]
position_m = PLACE
radius_m = 30
[hazard]
author = "A. Muster, Muster Ltd"
date = "2026-05-31"
namespace = "AT.0099.NZ"
[hazard.class.all]
frequency_per_a = 0.01
TOML
place=$(ogr2ogr -f CSV /vsistdout/ slope/out/blocks.gpkg -dialect SQLite -sql "SELECT ST_X(ST_Centroid(geom)) x, ST_Y(ST_Centroid(geom)) y FROM blocks LIMIT 1" 2>/dev/null | tail -1)
sed -i "s/PLACE/[$place]/" slope/site.toml
made slope RUNS=2 report
for file in hazard/class.tif hazard/class.png hazard/hazard.gpkg hazard/filing.gpkg trace.gpkg links.csv sources/source_road.tif; do
  [ -f "slope/out/$file" ] || fail "no $file"
done
on_page slope/out/hazard/hazard.gpkg slope/out/trace.gpkg slope/out/links.csv
for words in 'What endangers the objects, and where to act' 'Hazard classes' 'road: where to act'; do
  grep -q "$words" slope/out/report.html || fail "the report does not say: $words"
done
unzip -p slope/out/site.qgz >project 2>/dev/null || python3 -c "
import zipfile, sys
z = zipfile.ZipFile('slope/out/site.qgz'); sys.stdout.write(z.read(z.namelist()[0]).decode())" >project
for group in 'Hazard classes' 'Frequency and return period' 'Objects' 'To be filed'; do
  grep -q "layer-tree-group name=\"$group\"" project || fail "the project has no group $group"
done
grep -q '<value>A. Muster, Muster Ltd</value>' project || fail 'the title block of the layout does not name the author'
made slope RUNS=2 report
prints 'Nothing to be done'
# another recipe is looked at before it is used; the runs stay
made slope RUNS=2 check
sed 's/^min_area_m2 = .*/min_area_m2 = 50/' "$source_dir/share/hazard/switzerland_ti.toml" >slope/own.toml
sed -i 's/^author/recipe = "own.toml"\n&/' slope/site.toml
made slope RUNS=2 -n check hazard
prints talus-check
prints talus-hazard
if grep -q talus-batch out; then fail 'another recipe repeats the runs'; fi
made slope RUNS=2 check
sed -i 's/^min_area_m2 = .*/min_area_m2 = 60/' slope/own.toml
made slope RUNS=2 -n check
prints talus-check
# a map that cannot be filed is refused before the runs
sed -i 's/^namespace = .*/namespace = "ti.ch"/' slope/site.toml
expect 2 make -C slope BIN= RUNS=2 check
says 'hazard.namespace: is of a canton, and the terrain is in EPSG:32633'
made slope clean
[ ! -e slope/out ] || fail "left: $(find slope/out)"
