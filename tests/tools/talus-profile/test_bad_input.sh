# Implausible lines, and runs that say nothing of any line.
run-probe . 2
line='250030,350004 250030,350020'
run() { code=$1; shift; expect "$code" talus-profile run_0.h5 run_1.h5 --trn slope.tif -o p.gpkg "$@"; nothing_left p.gpkg; }
run 2
says 'no line is given'
run 2 --line '250030,350004 250030;350020'
says "'250030;350020', expected two numbers as x,y"
run 1 --line '250030,350004'
says 'the line has 1 point, expected two or more'
run 1 --line '250030,350004 250030,390020'
says 'leaves the known terrain at (250030, '
says 'the terrain covers x 250000 to 250080'
run 1 --line '250030,350004 250030,350004'
says 'repeats the one before'
run 1 --line '250030,350004 250030,350020' --step-m 0.001
says 'stations every 0.001 m are 1.6e+04, expected up to 10000'
says 'hint: give a larger --step-m'
run 2 --line "$line" --bin-m 0

feature() { printf '{"type":"Feature","properties":{"name":"%s"},"geometry":{"type":"%s","coordinates":%s}}' "$@"; }
collection() { printf '{"type":"FeatureCollection","features":[%s]}' "$1"; }
collection "$(feature a LineString '[[250030,350004],[250030,350020]]'),$(feature b LineString '[[250040,350004],[250040,350020]]')" >two.geojson
ogr2ogr -a_srs EPSG:31254 two.gpkg two.geojson
run 1 --line-file two.gpkg
says 'two.gpkg: holds 2 lines, expected one'
says 'choose one, e.g. --line-file "FILE|subset=fid = 1"'
run 2 --line-file two.gpkg --line "$line"
says 'there are two lines'
run 1 --line-file "two.gpkg|subset=name = 'c'"
expect 0 talus-profile run_0.h5 run_1.h5 --trn slope.tif -o one.gpkg --line-file "two.gpkg|subset=name = 'b'"
prints 'line of 16 m: 2 blocks cross it'
collection '' >empty.geojson
run 1 --line-file empty.geojson
says 'empty.geojson'
: >nothing.geojson
run 1 --line-file nothing.geojson
says 'nothing.geojson'
collection "$(feature a Point '[250030,350004]')" >point.geojson
ogr2ogr -a_srs EPSG:31254 point.gpkg point.geojson
run 1 --line-file point.gpkg
says 'line'
# metres that are said to be degrees (as in GeoJSON), another zone
run 1 --line-file "two.geojson|subset=name = 'a'"
says 'two.geojson'
ogr2ogr -a_srs EPSG:32633 zone.gpkg two.geojson -where "name = 'a'"
run 1 --line-file zone.gpkg
says 'zone.gpkg'

# neither frames nor passages
mkdir bare
run-probe bare 1 passages=no frames=8
expect 1 talus-profile bare/run_0.h5 --trn bare/slope.tif -o p.gpkg --line "$line"
says 'bare/run_0.h5: has neither frames nor passages'
says 'hint: run talus-dda again'
nothing_left p.gpkg
# frames alone: crossings are known, and of the profile along the line the ground
mkdir framed
run-probe framed 1 passages=no
expect 0 talus-profile framed/run_0.h5 --trn framed/slope.tif -o framed.gpkg --line "$line" --json framed.json
says 'no run has passages: the profile along the line holds the ground alone'
prints '1 block crosses it in 1 of 1 run'
grep -q '"method": "ground alone"' framed.json || fail 'passages from nowhere'
# nothing comes
expect 0 talus-profile run_0.h5 run_1.h5 --trn slope.tif -o none.gpkg --line '250070,350004 250070,350020' --tables none
prints 'line of 16 m: nothing crosses it in 2 runs (95 %: 0 - 0.658); by frames'
expect 1 talus-profile slope.tif --trn slope.tif -o p.gpkg --line "$line"
: >empty.h5
expect 1 talus-profile empty.h5 --trn slope.tif -o p.gpkg --line "$line"
says 'empty.h5'
nothing_left p.gpkg
