# Soils: a raster of them, the output of --print-config, refusals.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs

cat >>site.toml <<'END'
[ground.grass]
soil = "meadow"
raster_values = [1]
[ground.bare]
soil = "rock"
rolling_resistance = 0
cor_half_speed_m_s = 100
raster_values = [2]
[terrain]
ground_raster = "classes.asc"
END
make_classes() {
  awk -v value="$1" 'BEGIN {
    print "ncols 16\nnrows 11\nxllcorner 499995\nyllcorner 4999995\ncellsize 10\nNODATA_value -9999"
    for (r = 0; r < 11; r++) { line = ""; for (c = 0; c < 16; c++) line = line " " value; print line }
  }' >classes.asc
}
make_classes 1

expect 0 run_dda -o run.h5 --print-config
prints "ground.grass.soil = \"'meadow'\""
prints "field test: 18 runs at Tschamut"
prints "ground.grass.bearing_kpa = 4000"
prints "soil meadow (field test)"
prints "soil rock (field test)"

displacement() { # displacement VALUE: the one that 90 % of the mass stays below on that soil
  make_classes "$1"
  expect 0 run_dda -o run.h5 --overwrite --json
  sed -n 's/.*"displacement_p90_m": \([0-9.]*\).*/\1/p' out | head -n 1
}
grass=$(displacement 1)
bare=$(displacement 2)
awk "BEGIN { exit !($grass < 0.5 * $bare) }" || fail "on meadow $grass m, on rock $bare m"

# all laws at once: the same when it is done again
make_classes 1
for run in once again; do
  expect 0 run_dda -o "$run.h5" --set ground.grass.scar_friction=1.5 --set ground.grass.scar_rate_1_m=1 \
    --set ground.grass.scar_decay_1_s=50 --set ground.grass.drag_1_s=0.3
done
cmp -s once.h5 again.h5 || fail "two runs with all laws of ground differ"

refuses() { # refuses WORDS --set KEY=VALUE ...
  words=$1
  shift
  expect "$exit_code" run_dda -o bad.h5 "$@"
  says "$words"
  nothing_left bad.h5
}
exit_code=2
refuses "expected one of rock|thin_soil|talus|scree|meadow|soft_soil|swamp|asphalt" --set ground.grass.soil=lawn
exit_code=1
refuses "has rolling_resistance and bearing_kpa, which exclude each other" \
  --set ground.grass.rolling_resistance=0.1 --set ground.grass.bearing_kpa=80
refuses "has scar_friction without scar_rate_1_m" --set ground.grass.scar_friction=2
