# Ground classes from a raster: each value has the friction of its section.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs

# classes.asc: VALUE everywhere, pixels of 10 m over the terrain; the rows south of row 5 have OTHER
make_classes() {
  awk -v value="$1" -v other="$2" 'BEGIN {
    print "ncols 16\nnrows 11\nxllcorner 499995\nyllcorner 4999995\ncellsize 10\nNODATA_value -9999"
    for (r = 0; r < 11; r++) {
      line = ""
      for (c = 0; c < 16; c++) line = line " " (r < 5 ? value : other)
      print line
    }
  }' >classes.asc
}
cat >>site.toml <<'END'
[ground.rough]
friction_deg = 60
cor = 0
raster_values = [3, 4]
[ground.smooth]
friction_deg = 5
cor = 0
raster_values = [9]
[terrain]
ground_raster = "classes.asc"
END

# speed: the largest of the run on these classes
speed() {
  make_classes "$1" "$2"
  expect 0 run_dda -o run.h5 --overwrite --json
  sed -n 's/.*"largest_speed_m_s": \([0-9.]*\).*/\1/p' out | head -n 1
}
is_slower() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a < 0.6 * b) }'; }
rough=$(speed 3 4)
smooth=$(speed 9 9)
mixed=$(speed 9 3)
unknown=$(speed -9999 -9999)
is_slower "$rough" "$smooth" || fail "rough ground: $rough m/s, smooth ground: $smooth m/s"
is_slower "$rough" "$mixed" || fail "smooth in the north: $mixed m/s, rough everywhere: $rough m/s"
is_slower "$rough" "$unknown" || fail "no class: $unknown m/s, expected that of [ground.ground]"

refuses() {
  expect 1 run_dda -o bad.h5
  says "$1"
  nothing_left bad.h5
}
make_classes 3 5
refuses "holds the value 5 below the terrain, which no [ground.*] names"
make_classes 3 9
sed 's/raster_values = \[9\]/raster_values = [9, 4]/' site.toml >twice.toml
expect 1 talus-dda twice.toml --trn slope.tif --blocks blocks.h5 -o bad.h5 --no-db --independent
says "the raster's value 4 stands for two grounds"
sed 's/^ground_raster.*//' site.toml >none.toml
expect 1 talus-dda none.toml --trn slope.tif --blocks blocks.h5 -o bad.h5 --no-db --independent
says "there is no raster"
exit 0
