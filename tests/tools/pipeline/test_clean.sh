# `make clean` removes all files of the pipeline, and nothing else.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
made slope -j2 RUNS=2 DDA_FLAGS='--set output.checkpoint_interval_s=0.01'
echo mine >slope/out/notes.txt
echo mine >slope/out/maps/drawing.txt
echo mine >slope/out/runs/run_of_mine.h5
echo mine >slope/out/stages/remarks.txt
touch slope/out/maps/velocity.tif.aux.xml slope/out/blocks.gpkg.aux.xml slope/out/runs.sqlite-wal slope/out/.trn.part-elsewhere-77.tif
touch slope/out/runs/run_7.h5.part slope/out/runs.sqlite.late-elsewhere-77
mkdir slope/out/.trn.part-elsewhere-77-abcdef slope/out/stages/.runs.txt.part-77-abcdef
touch slope/out/.trn.part-elsewhere-77-abcdef/trn.tif
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

# a file that the site file names stays, under any name and spelling
site kept
made kept terrain
for name in fence.gpkg blocks.gpkg runout.gpkg trace.gpkg hazard.json; do echo mine >kept/out/$name; done
cat >>kept/site.toml <<END
# it's a "remark" about 'out/hazard.json
[place.a]
polygon_file = "out/fence.gpkg|layername=it's"
[place.b]
polygon_file = 'out/../out/blocks.gpkg'
[place.c]
polygon_file = "$PWD/kept/out/runout.gpkg"
[place.d]
polygon_file = "elsewhere/trace.gpkg"
END
made kept clean
prints "left in out: blocks.gpkg fence.gpkg runout.gpkg"
[ "$(cat kept/out/*)" = "mine
mine
mine" ] || fail "left: $(ls kept/out)"

# foreign folders
mkdir mine
echo precious >mine/notes.txt
echo precious >mine/report.html
site other
for out in ../mine ../nowhere; do
  made other OUT=$out clean
  [ "$(cat mine/*)" = "precious
precious" ] || fail "clean of $out removed a file of mine"
done
expect 2 make -C other BIN= OUT=../mine
says "../mine/report.html was not made by the pipeline"
[ "$(cat mine/report.html)" = precious ] || fail "a file of mine was replaced"

# the site's own folder, by any name, and folders that hold inputs of the site
ln -s other alias
for out in . ./ ../other ../alias/ "$PWD/other" "$PWD/mine/../alias"; do
  for goal in clean terrain; do
    expect 2 make -C other BIN= OUT="$out" $goal
    says "the site's own folder"
  done
done
mkdir other/data
mv other/contours.gpkg other/data
sed -i 's#^contours = .*#contours = "data/contours.gpkg"#' other/site.toml
for out in data "$PWD/alias/data" ..; do
  expect 2 make -C other BIN= OUT="$out" terrain
  says "is an input and lies in"
done
cp other/data/contours.gpkg mine/given.gpkg
rm mine/report.html
expect 2 make -C other BIN= OUT=../mine CONTOURS=../mine/given.gpkg -n terrain
says "../mine/given.gpkg: is an input and lies in ../mine"
rm -r other/data/stages stages
made other terrain
made other clean
[ "$(find other -type f | sort | tr '\n' ' ')" = "other/Makefile other/data/contours.gpkg other/site.toml " ] ||
  fail "left: $(find other)"
