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
expect 1 talus-dda twice.toml --trn slope.tif --blocks blocks.h5 -o bad.h5 --no-db --set solver.blocks=alone
says "the raster's value 4 stands for two grounds"
sed 's/^ground_raster.*//' site.toml >none.toml
expect 1 talus-dda none.toml --trn slope.tif --blocks blocks.h5 -o bad.h5 --no-db --set solver.blocks=alone
says "there is no raster"

# Commands of the hints are run: their raster gives the run of the right raster.
speed_on() { # speed_on RASTER
  sed "s/^ground_raster.*/ground_raster = \"$1\"/" site.toml >other.toml
  expect 0 talus-dda other.toml --trn slope.tif --blocks blocks.h5 -o run.h5 --overwrite --no-db --set solver.blocks=alone --json
  sed -n 's/.*"largest_speed_m_s": \([0-9.]*\).*/\1/p' out | head -n 1
}
refuses_raster() { # refuses_raster RASTER WORDS
  sed "s/^ground_raster.*/ground_raster = \"$1\"/" site.toml >other.toml
  expect 1 talus-dda other.toml --trn slope.tif --blocks blocks.h5 -o bad.h5 --no-db --set solver.blocks=alone
  says "$2"
}
run_hint() { sed -n 's/^ *hint: .*\(gdal[a-z]* .*\)$/\1/p' err >hint.sh && sh -e hint.sh >/dev/null; }
make_classes 3 9
right=$(speed_on classes.asc)
gdalwarp -q -r near -tr 0.00002 0.00002 -s_srs EPSG:32632 -t_srs EPSG:4326 classes.asc degrees.tif
refuses_raster degrees.tif "the terrain is in EPSG:32632"
run_hint
[ "$(speed_on in_system.tif)" = "$right" ] || fail "reprojected classes: $(speed_on in_system.tif) m/s, expected $right"
gdal_translate -q -a_srs EPSG:32632 -a_ullr 499995 4999995 500155 5000105 classes.asc south_up.tif
refuses_raster south_up.tif "do not run from north to south"
run_hint
awk 'NR <= 6 { print; next } { row[NR] = $0 } END { for (r = NR; r > 6; r--) print row[r] }' classes.asc >flipped.asc
[ "$(speed_on north_up.tif)" = "$(speed_on flipped.asc)" ] || fail "turned classes: $(speed_on north_up.tif) m/s"
