# The page that says how a recipe is written, word for word, and the recipes that are shipped, on boxes whose energies
# are known: column 10 of the cells is passed at 99 to 129 kJ, column 5 at less than 30 kJ.
page=$source_dir/docs/guide/recipes.md
block() { awk -v wanted="$1" '/^```toml$/ { n++; on = n == wanted; next } /^```/ { on = 0 } on' "$page"; }
run-probe . 12 blocks=3 objects=watched
cp site.toml plain.toml
block 1 >valley.toml
with() { { cat plain.toml; printf '\n[hazard]\nrecipe = "%s"\n[hazard.class.all]\nfrequency_per_a = %s\n' "$1" "$2"; } >site.toml; }
value() { cell "$1/$2.tif" 1 "$3" 10; }
classes() { echo "$(value "$1" class 10) $(value "$1" class 5)"; }

# once in 73.5 years: above 50 kJ within 500 years is "watch", less is nothing; once in 33 years one class more
with valley.toml 0.0136
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o valley --pages png --json valley.json
[ "$(classes valley)" = '1 255' ] || fail "classes of the page: $(classes valley), expected 1 255"
with valley.toml 0.03
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o often
[ "$(classes often)" = '2 1' ] || fail "classes of the page, more often: $(classes often), expected 2 1"
# map, polygons and styles have its colours, labels and sources
gdalinfo valley/class.tif | grep -q '1: 250,190,60,255' || fail 'no colour of the recipe'
gdalinfo valley/class.tif | grep -qF 'RECIPE_SOURCE=return_period_a, intensity, matrix: Minutes of the council, 12 May 2026, item 4 (v); class: Our office' ||
  fail 'no source of the recipe in the tags'
gdalinfo valley/class.tif | grep -q 'SPLIT=' && fail 'a side is told of cells that have one class'
grep -q 'look every spring' valley/class.qml || fail 'no label of the recipe in the style'
ogr2ogr -f CSV polygons.csv valley/hazard.gpkg classes && grep -q '^watch,"*1"*,look every spring,' polygons.csv || fail 'no polygon'
[ -f valley/ke_T50.tif ] && [ -f valley/return_period_50kJ.tif ] && [ ! -e valley/ke_T100.tif ] || fail 'maps of other limits'
grep -q 'Our valley, draft of 2026, mark v; class o' valley.json || fail 'the note does not say the marks'

# each shipped recipe of cells, in 73.5 years: yellow of 4b at the canton, too often for S1 to S3, for permits
for of in switzerland_ti:3 norway_tek17:3 british_columbia:2; do
  name=${of%:*}
  with "$name" 0.0136
  expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o "$name"
  [ "$(value "$name" class 10)" = "${of#*:}" ] || fail "class by $name: $(value "$name" class 10), expected ${of#*:}"
done
[ -f british_columbia/ke_T475.tif ] && [ -f british_columbia/ke_T475.qml ] || fail 'no map of 10 % in 50 years'
for file in "$source_dir"/share/hazard/*.toml; do
  name=$(basename "$file" .toml)
  grep -qF "| \`$name\` |" "$page" || fail "the page does not name recipe $name"
done

# risk: without who is there it is refused; then objects have a class and cells none
block 2 >road.toml
with road.toml 0.0136
expect 1 talus-trace site.toml run_*.h5 --trn slope.tif -o risk.gpkg
says 'object.house: recipe Our road is of risk, and the object has no presence'
nothing_left risk.gpkg
block 3 | sed 1d >keys.toml
for object in house hut shed; do sed -i "/^\[object.$object\]/r keys.toml" plain.toml; done
with road.toml 0.0136
expect 0 talus-trace site.toml run_*.h5 --trn slope.tif -o risk.gpkg --json risk.json
prints 'annual individual risk 0.0047'
prints 'close the road'
cat >check.py <<'PY'
import json, math
house, hut, shed = json.load(open('risk.json'))['objects']
# each run crushes the house: 0.7 of the time there, one of two dies
assert abs(house['risk']['individual_per_a'][0] - (1 - math.exp(-0.7 * 0.5 * 0.0136))) < 1e-9, house['risk']
assert abs(house['risk']['deaths_per_a'] - 4 * 0.7 * 0.5 * 0.0136) < 1e-9
low = house['run_share_interval'][0]  # Wilson's, of the share of the runs
assert abs(house['risk']['individual_per_a'][1] - (1 - math.exp(-0.7 * 0.5 * 0.0136 * low))) < 1e-9
assert house['risk']['class'] == 'act' and house['risk']['certain']
# none of 12 runs hits the shed: the bound says that it may be looked at yet
assert shed['risk']['individual_per_a'][0] == 0 and shed['risk']['class'] == 'fine' and not shed['risk']['certain']
PY
python3 check.py || fail 'the risk is another one'
ogrinfo -q risk.gpkg objects | grep -q 'label (String) = close the road' || fail 'no class at the object'
ogrinfo -q risk.gpkg layer_styles | grep -q '200,30,30' || fail 'the object does not have the colour of its class'
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o cells --json cells.json
grep -q 'recipe Our road is of risk: cells have no class' cells.json || fail 'the result does not say why cells have no class'
[ -f cells/return_period_0kJ.tif ] && [ ! -e cells/class.tif ] && [ ! -e cells/hazard.gpkg ] || fail 'cells have a class of risk'
with new_zealand_christchurch 0.0136
expect 1 talus-trace site.toml run_*.h5 --trn slope.tif -o zealand.gpkg
says 'vulnerability has 2 numbers'
sed -i 's/^vulnerability = .*/vulnerability = [0.5]/' site.toml
expect 0 talus-trace site.toml run_*.h5 --trn slope.tif -o zealand.gpkg
prints 'intolerable: one in 10,000 a year or more'
# who is there means nothing to a recipe of cells, which is said
with valley.toml 0.0136
expect 0 talus-trace site.toml run_*.h5 --trn slope.tif -o cells.gpkg
says 'presence, vulnerability and persons_per_day of house, hut, shed are not used; recipe Our valley has no [risk]'
