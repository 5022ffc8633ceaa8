# Leftovers of an earlier site file or of other runs are not shown: the report and the project
# are those of a folder without leftovers, and name the files left out.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
command -v unzip >/dev/null || skip "needs unzip"
site slope
made slope -j2 RUNS=2
grep -q 'id="fences"' slope/out/report.html || fail "no fences in the report"

# shown SITE: headings, pictures and rows of the report, layers of the project
shown() {
  grep -o 'alt="[^"]*"\|<h2>[^<]*\|<section id="[a-z]*"\|<tr><td>[A-Z][a-z ]*<' "$1/out/report.html"
  unzip -p "$1/out/site.qgz" | grep -o '<datasource>[^<]*'
}
# shows_as_new: the report and the project equal those of a clean folder
shows_as_new() {
  site new
  cp slope/site.toml new/site.toml
  cp slope/dem.tif new/dem.tif 2>/dev/null || true
  made new -j2
  shown slope >shown_here
  shown new >shown_new
  [ "$(wc -l <shown_new)" -gt 30 ] || fail "what is shown was not found"
  diff shown_here shown_new >&2 || fail "$1: not what a clean folder shows"
  rm -r new
}

cp slope/site.toml site.toml
sed -i 's/^active = true/active = false/' slope/site.toml
made slope -j2
says "left out: change.tif, change.png, change.qml: not of the runs"
shows_as_new "a fence that stands no more"

sed -i '/^\[fence/,$d' slope/site.toml
made slope -j2
says "left out: fence.json: the site has no fences"
says "left out: fence.gpkg: the site has no fences"
if grep -q 'change by the fence' slope/out/report.html; then fail "a change by no fence"; fi
shows_as_new "a site without fences"

gdal_translate -q -ot Float64 -a_srs EPSG:32633 -a_ullr 499996 5200324 500228 5199996 \
  "$source_dir/sample_sites/designed/slope.asc" slope/dem.tif
sed -i -e 's/^contours = .*/dem = "dem.tif"/' -e '/^elevation_field/d' slope/site.toml
made slope -j2
says "left out: tin.json: the terrain is made from"
shows_as_new "a terrain from a DEM"

# other runs than those of the maps; a site file that is not that of the runs
cp site.toml slope/site.toml
made slope -j2 RUNS=2
expect 0 talus-runout slope/out/runs/run_1.h5 --trn slope/out/bed.tif -o slope/out/runout.gpkg \
  --json slope/out/runout.json --overwrite --no-db
expect 0 talus-report slope/site.toml --dir slope/out -o one.html --no-db
says "maps/velocity.tif: not of the runs that runout.json is of"
says "left out: fence.json: not of the runs"
if grep -q 'src="data:image/png' one.html; then fail "maps of other runs"; fi
expect 0 talus-runout slope/out/runs/run_1.h5 --trn slope/out/bed.tif -o other.gpkg --overwrite --no-db --path-tolerance-m 1
cp other.gpkg slope/out/runout.gpkg
expect 0 talus-report slope/site.toml --dir slope/out -o two.html --no-db
says "left out: runout.gpkg: not of the run of talus-runout"

refused() {
  expect 1 talus-report other.toml --dir slope/out -o other.html --no-db
  says "$1"
  nothing_left other.html
}
sed 's/^name = .*/name = "another"/' slope/site.toml >other.toml
refused "run_1.h5: was computed with other settings than the site file has: site.name: 'designed', there 'another'"
sed 's/^height_m = 8/height_m = 9/' slope/site.toml >other.toml
refused "fence.valley.height_m: 8, there 9"
sed '/^\[fence/,$d' slope/site.toml >other.toml
refused ", there not given"
sed 's/^depth_m = .*//; s/^plane_dip_deg = .*/plane_dip_deg = 30/' slope/site.toml >other.toml
refused "source.plane_dip_deg: 33, there 30"
sed 's/^\[solver\]/&\nn_runs = 7/' slope/site.toml >other.toml
expect 0 talus-report other.toml --dir slope/out -o other.html --no-db
cp slope/out/trn.tif slope/out/bed.tif
expect 1 talus-report slope/site.toml --dir slope/out -o three.html --no-db
says "bed.tif: is not the terrain of the runs"

for content in '{}' '{"runs": []}' '{"runs": [{"run_id": 1}]}' '[]'; do
  echo "$content" >slope/out/runout.json
  expect 1 talus-report slope/site.toml --dir slope/out -o three.html --no-db
  says "slope/out/runout.json"
  if grep -q unexpected err; then fail "runout.json with $content is not looked at"; fi
done
