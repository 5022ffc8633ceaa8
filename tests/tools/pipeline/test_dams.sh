# A dam of the site: make burns it into the terrain before blocks are cut, anew when it changes, and
# the report gives the arrivals at it; a gallery as a measure.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
awk 'BEGIN { print "ncols 60\nnrows 80\nxllcorner 650000\nyllcorner 5200000\ncellsize 2\nNODATA_value -9999"
  for (r = 0; r < 80; r++) { y = 2 * (79 - r); z = 500 + 0.1 * y + (y > 60 ? 0.75 * (y - 60) : 0)
    for (c = 0; c < 60; c++) printf "%g ", z; print "" } }' >dem.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 dem.asc dem.tif
mkdir wall
echo "include $source_dir/pipelines/site.mk" >wall/Makefile
cat >wall/site.toml <<'TOML'
[site]
name = "wall"
[terrain]
dem = "../dem.tif"
[ground.slope]
friction_deg = 30
[rockfall.top]
position_m = [[650050, 5200140], [650060, 5200140], [650070, 5200140]]
shape = "rock"
volume_m3 = 0.5
height_above_ground_m = 2
rocks = 4
[dam.road]
line = [[650020, 5200040], [650100, 5200040]]
height_m = 4
crest_width_m = 4
slopes_deg = [45, 34]
ditch_m = [1, 4]
capacity_kj = 1500
[solver]
duration_s = 20
n_runs = 3
TOML
made wall -j2
python3 - <<'PY' || fail 'the dam in terrain and results'
import json
dam, = json.load(open("wall/out/trn.json"))["dams"]
assert dam["designed"]["fill_m3"] > 1500 and dam["designed"]["cut_m3"] > 200, dam
dam, = json.load(open("wall/out/fence.json"))["dams"]
assert sum(v["n"] for v in dam["verdicts"].values()) == 36 and dam["arriving"]["n"] > 0, dam
PY
grep -q 'dam road: 80 m long' wall/out/report.html || fail 'no dam in the report'
made wall # nothing to do
sed -i 's/^capacity_kj.*/capacity_kj = 1200/' wall/site.toml
expect 0 make -C wall BIN= -n
grep -q 'talus-trn\|talus-dda' out && fail 'another capacity makes the terrain or runs anew'
sed -i 's/^height_m = 4/height_m = 3/' wall/site.toml
made wall terrain
prints 'trn: elevation model -> terrain'

# a gallery as a measure: the lane under it is hit no more
cat >>wall/site.toml <<'TOML'
[dam.shed]
kind = "gallery"
active = false
line = [[650020, 5200064], [650100, 5200064]]
height_m = 5
crest_width_m = 16
[object.lane]
line = [[650024, 5200062], [650096, 5200062]]
width_m = 4
[variant.gallery]
without = ["dam.road"]
dam.shed.active = true
TOML
made wall -j2
python3 - <<'PY' || fail 'the gallery as a measure'
import json
def lane(folder): return json.load(open(f'wall/out/{folder}trace.json'))['objects'][0]
site, shed = lane(''), lane('variant/gallery/')
assert site['hits_a_run'] > 0 and shed['hits_a_run'] == 0, (site, shed)
hits = shed['compared']['hits_a_run']
assert (hits['site'], hits['variant']) == (site['hits_a_run'], 0), hits
gallery, = json.load(open('wall/out/variant/gallery/fence.json'))['dams']
assert gallery['kind'] == 'gallery' and gallery['roof_hits']['blocks'] > 0, gallery
assert 'Measures compared' in open('wall/out/report.html').read()
page = open('wall/out/variant/gallery/report.html').read()
for words in 'gallery shed: 80 m long', 'energy normal to the roof', 'its strength is not checked':
    assert words in page, words
PY

# a dam that the terrain of before lacks: make makes the terrain again
sed -i '/^\[dam.shed\]/,/^active/s/^active.*/active = true/' wall/site.toml
made wall check
prints 'trn: elevation model -> terrain'
