# Twelve runs that all come once in 73.5 years with up to 187 kJ: blue where they have more than 30 kJ, yellow where
# less. None of 12 above 300 kJ may still be one in 303 years, so both are certain. The same bytes from parts and tiles.
run-probe . 12 blocks=3
cat >>site.toml <<'TOML'

[hazard.class.V1]
frequency_per_a = 0.0136
TOML
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o maps --pages png,pdf --json hazard.json
prints 'maps of 12 runs of class V1'
value() { cell "maps/$1.tif" "$2" "$3" 10; }
# cells of 2 m: column 10 is passed by box 0 at 99 to 129 kJ, column 5 at the start by less than 30
[ "$(value class 1 10)" = 3 ] || fail "class $(value class 1 10), expected 3"
[ "$(value class_certain 1 10)" = 1 ] || fail 'a class that is the same at both bounds is not certain'
[ "$(value class_certain 4 10)" = 5 ] || fail 'the number of the matrix'
[ "$(value class 1 5)" = 2 ] && [ "$(value class_certain 4 5)" = 2 ] || fail 'weak at 100 years is not yellow, number 2'
[ "$(value class 1 38)" = 255 ] || fail 'a cell that nothing reached has a class'
[ "$(value intensity 1 10) $(value intensity 2 10)" = '0 2' ] || fail 'intensity at 30 and 100 years'
for band in 1 2; do value return_period_30kJ $band 10; done | tr '\n' ' ' >periods
[ "$(cut -c1-7 periods)" = 73.5294 ] || fail "return periods $(cat periods)"
value event_frequency 1 10 >f && [ "$(cut -c1-6 f)" = 0.0136 ] || [ "$(cut -c1-6 f)" = 0.0135 ] || fail "event frequency $(cat f)"
value passage_frequency 1 10 >f && [ "$(cut -c1-6 f)" = 0.0136 ] || [ "$(cut -c1-6 f)" = 0.0135 ] || fail "passage frequency $(cat f)"
for word in 'RECIPE=Switzerland, canton Ticino' RECIPE_EDITION RECIPE_SHA256 'SPLIT=a' 'FREQUENCIES=V1: 0.0136 a year' \
  'MODE=diffuse' FREQUENCY_UPPER_BOUND_ELSEWHERE 'N_RUNS=12'; do
  gdalinfo maps/class.tif | grep -qF "$word" || fail "class.tif does not say $word"
done
gdalinfo maps/class.tif | grep -q 'Type=Byte' || fail 'class.tif is not of bytes'
gdalinfo maps/class.tif | grep -q '3: 85,142,213,255' || fail 'no colour of class blue'
[ -f maps/class.png ] && [ -f maps/class.pdf ] && [ -f maps/ke_T300.qml ] || fail 'no page or style'
ogr2ogr -f CSV classes.csv maps/hazard.gpkg classes && grep -q '^blue,.*medium hazard' classes.csv || fail 'no polygon of class blue'
grep -q 'class V1: 12 runs, 0.0136 a year' classes.csv || fail 'polygons do not say what they rest on'
ogrinfo -q maps/hazard.gpkg | grep -q classes_smoothed || fail 'no smoothed classes'

expect 0 talus-reduce run_1.h5 run_4.h5 run_7.h5 --trn slope.tif -o third.h5
expect 0 talus-reduce run_0.h5 run_2.h5 run_3.h5 run_5.h5 run_6.h5 run_8.h5 --trn slope.tif -o half.h5
expect 0 talus-hazard site.toml run_9.h5 half.h5 run_11.h5 third.h5 run_10.h5 --trn slope.tif -o parts --pages png,pdf
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o tiles --pages png,pdf --memory-mb 0.004
for file in maps/*.tif maps/*.png maps/*.pdf maps/*.qml; do
  cmp "$file" "parts/${file#maps/}" || fail "$file depends on how the runs are read"
done
for file in maps/*.tif; do  # its settings are in the tags
  gdalinfo -checksum "$file" | grep Checksum >whole
  gdalinfo -checksum "tiles/${file#maps/}" | grep Checksum | cmp - whole || fail "$file depends on the tiles"
done

# the other side of the matrix, and two classes that are told apart
sed 's/^split = .*/split = "b"/' "$source_dir/share/hazard/switzerland_ti.toml" >b.toml
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o split --set hazard.recipe=b.toml --set hazard.class.V1.frequency_per_a=0.04
[ "$(gdallocationinfo -valonly -b 1 split/class.tif 10 10)" = 4 ] || fail 'split b is not red'
cat >>site.toml <<'TOML'
[hazard.class.V5]
events = 0
observed_a = 1000
TOML
mkdir -p cases/V1 cases/V5 cases/V9
run-probe cases/V1 9 blocks=3 case=V1
rm cases/V1/run_[01267].h5
run-probe cases/V5 1 blocks=3 case=V5 seed=1
run-probe cases/V9 2 blocks=3 case=V9 seed=2  # of no class
expect 0 talus-hazard site.toml cases --trn slope.tif -o two
gdalinfo two/class.tif | grep -q 'N_RUNS=5$' || fail 'the runs of two classes are not told apart by their cases'
value=$(gdallocationinfo -valonly -b 1 two/event_frequency.tif 10 10)
case $value in 0.0141* | 0.01409*) ;; *) fail "frequency of two classes: $value, expected 0.0136 + 0.5 / 1000" ;; esac
