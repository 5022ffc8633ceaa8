# From contours to the report in one command; twice does nothing; -j2 and a second clean run give the
# same bytes.
. "$source_dir/tests/tools/pipeline/common.sh"
site one
made one -j2
for name in trn.tif blocks.h5 runs/run_1.h5 without/run_1.h5 runout.gpkg maps/velocity.tif fence.json report.html site.qgz; do
  [ -s "one/out/$name" ] || fail "no $name"
done
on_page one/out/blocks.gpkg one/out/runout.gpkg one/out/fence.gpkg one/out/runout.csv one/out/runs.csv \
  one/out/curves.csv one/out/sensitivity.csv one/out/fence.csv
made one
prints "Nothing to be done for 'all'"
expect 0 make -q -C one BIN=

site two
made two
same one two
made one clean
nothing_left one/out
made one help
prints "terrain: contours or elevation model -> terrain"
nothing_left one/out
