# `make clean` removes what the pipeline made, all of it, and nothing else.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
made slope -j2 RUNS=2 DDA_FLAGS='--checkpoint-interval-s 0.01'
echo mine >slope/out/notes.txt
echo mine >slope/out/maps/drawing.txt
echo mine >slope/out/runs/run_of_mine.h5
echo mine >slope/out/stages/remarks.txt
touch slope/out/maps/velocity.tif.aux.xml slope/out/runs.sqlite-wal slope/out/.trn.part-elsewhere-77.tif
touch slope/out/runs/run_7.h5.part slope/out/runs.sqlite.late-elsewhere-77
made slope clean
prints "left in out: maps notes.txt runs stages"
left=$(cd slope/out && find . -type f | sort | tr '\n' ' ')
[ "$left" = "./maps/drawing.txt ./notes.txt ./runs/run_of_mine.h5 ./stages/remarks.txt " ] || fail "left: $left"
made slope clean
prints "out holds nothing that the pipeline made"
rm -r slope/out

# the results of one make are gone with their folder, whatever the site file says by now
made slope terrain
echo 'no TOML' >slope/site.toml
made slope clean
[ ! -e slope/out ] || fail "slope/out was left: $(find slope/out)"

# folders of others, and the site's own
mkdir mine
echo precious >mine/notes.txt
echo precious >mine/report.html
site other
for out in ../mine ../other . ../nowhere; do
  made other OUT=$out clean
  [ "$(cat mine/*)" = "precious
precious" ] || fail "clean of $out removed a file of mine"
  [ -s other/site.toml ] && [ -s other/Makefile ] && [ -s other/contours.gpkg ] || fail "clean of $out hurt the site"
done
expect 2 make -C other BIN= OUT=../mine
says "../mine/report.html was not made by the pipeline"
[ "$(cat mine/report.html)" = precious ] || fail "a file of mine was replaced"
made other OUT=. terrain
made other OUT=. clean
[ "$(ls other | tr '\n' ' ')" = "Makefile contours.gpkg site.toml " ] || fail "OUT=. left $(ls other)"
