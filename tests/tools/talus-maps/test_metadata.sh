# Metadata of a map for any reader: place, unit, meaning, nodata, from which runs, over what, how
# sound.
run-probe . 3
expect 0 talus-maps run_0.h5 run_1.h5 run_2.h5 --trn slope.tif -o maps --json
prints '"n_runs": 3'
for name in reach velocity ke_translational ke_total pass_height_centroid pass_height_top exceedance deposit arrival energy_line; do
  [ -f "maps/$name.tif" ] && [ -f "maps/$name.qml" ] || fail "maps/$name is missing"
  gdalinfo "maps/$name.tif" >info
  for word in 'EPSG",31254' 'NoData Value=-9999' 'Unit Type:' 'Description =' 'long_name=' RUN_ID= N_RUNS=3 \
      'DENOMINATOR=N = 3' HEALTH= HEALTH_LARGEST_PENETRATION_M=0.002 LAYOUT=COG; do
    grep -qF -- "$word" info || fail "maps/$name.tif does not say $word"
  done
  grep -q 'colorrampshader' "maps/$name.qml" || fail "maps/$name.qml is no style"
done
grep -q WARNINGS= info && fail "a warning where there was none"
grep -q 'value="30".*10 - 30 kJ (low)' maps/ke_total.qml || fail 'no class break at 30 kJ'
grep -q 'value="300".*(medium)' maps/ke_total.qml || fail 'no class break at 300 kJ'
grep -q 'alpha="0" label="0"' maps/reach.qml || fail 'zero is not transparent'
