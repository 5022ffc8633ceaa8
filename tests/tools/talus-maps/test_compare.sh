# Two ensembles on one map: the difference of the first from the second, from runs or from parts.
mkdir a b
run-probe a 60
run-probe b 40 seed=2 still_runs=20
expect 0 talus-maps a/run_*.h5 --compare b/run_*.h5 --trn a/slope.tif -o maps --pages png
expect 0 talus-maps a/run_*.h5 --trn a/slope.tif -o alone
gdalinfo maps/compare.tif >info
grep -q 'N_RUNS=60$' info && grep -q 'N_RUNS_COMPARED=40$' info || fail 'the tags do not tell the two apart'
for file in reach velocity ke_total deposit; do
  for folder in maps alone; do gdal_translate -q -of ENVI "$folder/$file.tif" $folder.raw; done
  cmp maps.raw alone.raw || fail "$file of the first set hangs on the second"
done
[ -s maps/compare.png ] && [ -s maps/compare.qml ] || fail 'no style or picture'
grep -q 'DIFFERENCE=these runs minus those compared with' info || fail 'the legend does not say what is taken from what'
# all of the 60 come by at x = 31, y = 10, half of the 40: 0.5, by Newcombe's interval of 60/60 and 20/40
value() { gdallocationinfo -valonly -geoloc -b "$1" maps/compare.tif 250031 350010; }
printf '%s %s %s\n' "$(value 1)" "$(value 2)" "$(value 3)" | awk '{
  z = 1.959963984540054; z2 = z * z
  a_low = 60 / (60 + z2); half = z * sqrt(0.25 / 40 + z2 / 6400) / (1 + z2 / 40)
  low = 0.5 - sqrt(half * half + (1 - a_low) ^ 2); high = 0.5 + half
  if ($1 - 0.5 > 1e-6 || $1 - 0.5 < -1e-6 || $2 - low > 1e-5 || low - $2 > 1e-5 || $3 - high > 1e-5 || high - $3 > 1e-5) {
    print $0, "expected 0.5", low, high; exit 1 } }' || fail 'the difference of reach is another one'
# parts
expect 0 talus-reduce a/run_*.h5 --trn a/slope.tif -o a.h5
expect 0 talus-reduce b/run_*.h5 --trn a/slope.tif -o b.h5
expect 0 talus-maps a.h5 --compare b.h5 --trn a/slope.tif -o of_parts --pages png
for file in maps/*.tif maps/*.qml maps/*.png; do cmp "$file" "of_parts/${file#maps/}" || fail "$file of parts is another one"; done
expect 1 talus-maps a.h5 --compare b.h5 --trn a/slope.tif -o small --memory-mb 0.01
says 'give more --memory-mb'
