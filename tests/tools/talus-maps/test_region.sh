# The steep ground of a whole elevation model releases rocks; runs of parts of its sources, whose
# rocks cross into each other's ground, make the results of one run of all.
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
# 60 x 60 cells of 4 m: down to the south-west by 45 degrees at first, then by 14
awk 'BEGIN { print "ncols 60\nnrows 60\nxllcorner 650000\nyllcorner 5200000\ncellsize 4\nNODATA_value -9999"
  for (r = 0; r < 60; r++) { for (c = 0; c < 60; c++) { d = (c + 59 - r) * 2.83
    printf "%.3f ", 500 + 0.25 * d + (d > 200 ? 0.75 * (d - 200) : 0) + sin(c) * cos(r) / 9 }; print "" } }' >dem.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 dem.asc dem.tif
expect 0 talus-trn dem.tif -o trn.tif --no-db
site() { # site FILE SECTIONS: sources of rocks with these keys, one a line, by name
  { printf '[site]\ncrs = "EPSG:25832"\n'
    printf "$2" | while read -r name keys; do
      printf '[rockfall.%s]\nmin_slope_deg = 40\nrelease_spacing_m = 16\nshape = "rock"\nsize_m = [1.2, 1, 0.8]\nvolume_m3 = 0.5\n' "$name"
      [ -z "$keys" ] || echo "$keys"
    done
    printf '[ground.slope]\nfriction_deg = 30\ncor = 0.3\nrolling_resistance = 0.3\n'
    printf '[solver]\nduration_s = 20\n[output]\nframes = false\n'; } >"$1.toml"
}
run() { # run NAME: the blocks, the run and the maps of NAME.toml
  expect 0 talus-blocks "$1.toml" --trn trn.tif -o "$1.blocks.h5" --no-db
  expect 0 talus-dda "$1.toml" --trn trn.tif --blocks "$1.blocks.h5" -o "$1.h5" --no-db
  expect 0 talus-maps "$1.h5" --trn trn.tif -o "$1" --no-db
}

# without a place all ground that is steep enough; cells that overhang the rim are left out
site all 'everywhere\n'
expect 0 talus-blocks all.toml --trn trn.tif -o all.h5 --no-db --set rockfall.everywhere.volume_m3=50
says 'of the ground of the terrain is 40 deg steep or more'
says ' rocks at the rim of the known ground left out'
# 'north' is the part of an area that 'south' is below: its rocks roll into the other's ground
north='north polygon = [[650010, 5200180], [650230, 5200180], [650230, 5200230], [650010, 5200230]]\n'
south='south polygon = [[650010, 5200010], [650230, 5200010], [650230, 5200180], [650010, 5200180]]\n'
site north "$north"
site south "$south"
site both "$north$south"
for name in north south both; do run $name; done
cat >check.py <<'PY'
from osgeo import gdal
gdal.UseExceptions()
def cells(run, layer, band):
    dataset = gdal.Open(f'{run}/{layer}.tif')
    found = next(b for b in (dataset.GetRasterBand(i + 1) for i in range(dataset.RasterCount)) if b.GetDescription() == band)
    return found.ReadAsArray()
n, s, both = (cells(name, 'reach', 'n_pass') for name in ('north', 'south', 'both'))
assert (n + s == both).all() and both.max() > 3
assert ((n > 0) & (s > 0)).sum() > 50  # cells that rocks of both parts come over
for layer, band in (('velocity', 'velocity_max'), ('ke_total', 'ke_total_max'), ('pass_height_top', 'pass_height_top_max')):
    n, s, both = (cells(name, layer, band) for name in ('north', 'south', 'both'))
    import numpy
    assert (numpy.maximum(n, s) == both).all(), band
PY
for python in python3 /usr/bin/python3; do
  "$python" -c 'from osgeo import gdal_array' 2>/dev/null && break
done || skip 'no Python bindings of GDAL'
"$python" check.py || fail 'parts do not make the whole'
