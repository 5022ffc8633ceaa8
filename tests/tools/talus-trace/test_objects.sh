# Box 0 hits the house, box 2 the hut, nothing the shed: sources, sums, and the energy of the slide.
run-probe . 12 blocks=3 objects=watched
expect 0 talus-trace site.toml run_*.h5 --trn slope.tif -o trace.gpkg --json trace.json --csv links.csv --rasters sources --pages png
prints 'house: hit in 12 of 12 runs'
cat >check.py <<'PY'
import json, math
t = json.load(open('trace.json'))
house, hut, shed = t['objects']
cos = math.cos(math.pi / 6)
e = [0.5 * 2600 * 6 * (1 + 0.01 * r) * 18.5 / cos / 1e3 for r in range(12)]  # at x = 29.5
assert abs(house['ke_max_kj'] - max(e)) < 2e-3 * max(e), (house['ke_max_kj'], max(e))
assert house['method'] == hut['method'] == 'recorded'
assert house['n_hits'] == 12 and hut['n_hits'] == 12 and shed['n_hits'] == 0
assert abs(house['block_share'] - 1 / 3) < 1e-9 and shed['run_share'] == 0
low, high = shed['run_share_interval']
assert low == 0 and abs(high - 0.242494) < 1e-5, high  # Wilson of 0 of 12 is not 0
assert house['n_sources_50_90_100'] == [1, 1, 1]
assert [round(s['share_of_hits'], 9) for s in house['sources']] == [1] and house['sources'][0]['p_hit'] == 1
c = t['conservation']
assert [o['hits_from_sources'] for o in c['objects']] == [12, 12, 0]
assert c['n_released'] == 36 and c['n_hit_none'] == 12 and c['n_hits_and_none'] == 36
PY
python3 check.py || fail 'the trace is another one'
[ "$(wc -l <links.csv)" = 3 ] || fail 'links.csv does not have a row a link'
[ "$(gdallocationinfo -valonly -b 1 sources/source_house.tif 5 10)" = 1 ] || fail 'the source cell of the house'
[ -f sources/source_house.png ] && [ -f sources/source_house.qml ] || fail 'no picture or style'
for layer in objects links source_cells; do ogrinfo -q trace.gpkg | grep -q "$layer" || fail "no layer $layer"; done

# names that differ in signs alone would be one raster
sed -e 's#object.house#object."a/b"#' -e 's#object.hut#object.a_b#' site.toml >names.toml
expect 1 talus-trace names.toml run_*.h5 --trn slope.tif -o names.gpkg --rasters names
says 'names.toml:'
says 'object.a_b: has the same raster as object a/b, source_a_b.tif'
nothing_left names.gpkg names/source_a_b.tif
expect 0 talus-trace names.toml run_*.h5 --trn slope.tif -o names.gpkg

# parts in any order
expect 0 talus-reduce run_0.h5 run_3.h5 run_6.h5 run_9.h5 --trn slope.tif -o a.h5
expect 0 talus-reduce run_1.h5 run_2.h5 run_4.h5 run_5.h5 run_7.h5 --trn slope.tif -o b.h5
expect 0 talus-reduce b.h5 a.h5 --trn slope.tif -o ab.h5
for set in 'b.h5 run_10.h5 a.h5 run_8.h5 run_11.h5' 'run_11.h5 ab.h5 run_8.h5 run_10.h5'; do
  expect 0 talus-trace site.toml $set --trn slope.tif -o parts.gpkg --json parts.json --csv parts.csv --rasters parts --pages png --overwrite
  cmp links.csv parts.csv && cmp sources/source_house.tif parts/source_house.tif || fail "$set give another trace"
done

# by cells no hit is missed, and an object that was drawn later is found; with a frequency it has a return period
mkdir drawn
run-probe drawn 12 blocks=3 objects=drawn
printf '[hazard.class.V1]\nfrequency_per_a = 0.01\n' >>drawn/site.toml
expect 0 talus-trace drawn/site.toml drawn/run_*.h5 --trn drawn/slope.tif -o drawn.gpkg --json drawn.json --csv drawn.csv
says 'was not watched by the runs'
prints 'house: hit in 12 of 12 runs (95 %: 0.758 - 1), once in 100 years'
expect 0 talus-trace site.toml run_*.h5 --trn slope.tif -o cells.gpkg --by-cells --csv cells.csv
cmp cells.csv drawn.csv || fail 'cells of watched and of drawn objects differ'
cut -d, -f1,2 links.csv >recorded && cut -d, -f1,2 cells.csv >cells
[ "$(sort -u recorded cells | wc -l)" = "$(sort -u cells | wc -l)" ] || fail 'a link is missing by cells'
expect 0 talus-reduce drawn/run_*.h5 --trn drawn/slope.tif -o drawn_part.h5
expect 0 talus-trace drawn/site.toml drawn_part.h5 --trn drawn/slope.tif -o drawn_part.gpkg --csv drawn_part.csv
cmp drawn.csv drawn_part.csv || fail 'a part gives other cells'
