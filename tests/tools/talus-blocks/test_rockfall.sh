# Rocks one by one: source cells, slopes, sizes and frequencies of [rockfall.*].
. "$source_dir/tests/tools/talus-blocks/scene.sh"
rocks() { # rocks KEYS...: a site with one source of these keys
  printf '%s\n' '[site]' 'crs = "EPSG:32633"' '[rockfall.cliff]' "$@" >site.toml
}
area='polygon = [[500010, 5200010], [500030, 5200010], [500030, 5200030], [500010, 5200030]]'

# The terrain dips about 40 degrees: all places of an area are steeper than 30, none than 60.
rocks 'shape = "eota221"' 'volume_m3 = 0.5' "$area" 'release_spacing_m = 4' 'min_slope_deg = 30'
expect 0 blocks --report r.json
says '100 % of the ground of its areas is 30 deg steep or more'
all=$(value r.json n_blocks)
holds "$all > 30 && ($(value r.json volume_m3) - 0.5 * $all) ^ 2 < 1e-16"
expect 1 blocks --overwrite --set rockfall.cliff.min_slope_deg=60
says 'no place releases rocks'
expect 0 blocks --overwrite --set rockfall.cliff.release_spacing_m=2 --set rockfall.cliff.rocks=3 --report r.json
holds "$(value r.json n_blocks) > 11 * $all && $(value r.json n_blocks) < 13 * $all"

# Sizes by a power law of exponent 3: rocks above V hold a share (0.1 / V)^2 of the volume.
rocks 'shape = "box"' 'size_m = [1, 1, 1]' 'volume_m3 = 0.1' 'volume_max_m3 = 1000' 'volume_exponent = 3' "$area" 'release_spacing_m = 2' 'rocks = 4' 'height_above_ground_m = 1'
expect 0 blocks --overwrite --report r.json
holds "$(value r.json n_blocks) > 500 && $(value r.json smallest_m3) >= 0.1"
holds "$(value r.json v50_m3) > 0.13 && $(value r.json v50_m3) < 0.155"
holds "$(value r.json v90_m3) > 0.24 && $(value r.json v90_m3) < 0.42"
expect 1 blocks --overwrite --set rockfall.cliff.volume_max_m3=0.05
says 'volume_m3 is the smallest volume of the power law'
expect 1 blocks --overwrite --set 'rockfall.cliff.volumes_m3=[1, 2]'
says 'says the sizes of its rocks in 2 ways'
rocks 'shape = "box"' 'size_m = [1, 1, 1]' 'volumes_m3 = [0.5, 2]' "$area" 'release_spacing_m = 2'
expect 0 blocks --overwrite --report r.json
n=$(value r.json n_blocks)
holds "$(value r.json volume_m3) > 0.5 * $n && $(value r.json volume_m3) < 2 * $n"

# Cells as of Rockyfor3D: 3 of 36 release rocks of their own extents and shape.
cells() { # cells NAME VALUE...: 6 x 6 cells of 4 m, of which the three in a row of the middle have these values
  { printf 'ncols 6\nnrows 6\nxllcorner 500010\nyllcorner 5200010\ncellsize 4\nNODATA_value -9999\n'
    printf '0 0 0 0 0 0\n0 0 0 0 0 0\n0 %s %s %s 0 0\n0 0 0 0 0 0\n0 0 0 0 0 0\n0 0 0 0 0 0\n' "$2" "$3" "$4"; } >"$1.asc"
}
cells rockdensity 2600 2600 2600
cells d1 1 2 1
cells d2 1 1 1
cells d3 1 1 0.5
cells blshape 1 1 3
rocks 'rockdensity_raster = "rockdensity.asc"' 'd1_raster = "d1.asc"' 'd2_raster = "d2.asc"' 'd3_raster = "d3.asc"' \
  'blshape_raster = "blshape.asc"' 'rocks = 2' '[material.rock]' 'density_kg_m3 = 2600'
expect 0 blocks --overwrite --report r.json
[ "$(value r.json n_blocks)" -eq 6 ] || fail 'not two rocks of each cell'
holds "($(value r.json volume_m3) - 2 * (1 + 2 + 3.14159265 / 12)) ^ 2 < 1e-12"
expect 1 blocks --overwrite --set material.rock.density_kg_m3=2700
says 'rockdensity.asc: rockdensity_raster is 2600 kg/m3, and the material has 2700 at 500016'
cells d3 1 1 0
expect 1 blocks --overwrite
says 'd3.asc: d3_raster is 0 m at'
cells d3 1 1 0.5
cells blshape 1 5 3
expect 1 blocks --overwrite
says '1 is a box, 2 an ellipsoid'

# Rocks of the form of the cells that the joints cut: as they are cut, or scaled.
joints=$(printf '[joints.%s]\ndip_deg = %s\ndip_direction_deg = %s\nspacing_m = %s\nspacing = "exponential"\n' \
  bedding 20 90 0.5 east 90 90 0.8 north 90 0 0.8)
rocks 'shape = "joint_cell"' "$area" 'release_spacing_m = 2' "$joints"
expect 0 blocks --overwrite --report r.json
says 'joint cells of '
holds "$(value r.json largest_m3) > 20 * $(value r.json smallest_m3)"
expect 0 blocks --overwrite --set rockfall.cliff.volume_m3=0.5 --report r.json
holds "($(value r.json volume_m3) - 0.5 * $(value r.json n_blocks)) ^ 2 < 1e-16"
expect 1 blocks --overwrite --set 'rockfall.cliff.size_m=[1, 1, 1]'
says 'has joint cells for its rocks, and the extents of another shape'
rocks 'shape = "joint_cell"' "$area"
expect 1 blocks --overwrite
says 'three or more make cells'

# Another sample draws other rocks; the same one the same.
rocks 'shape = "rock"' 'size_m = [1, 0.8, 0.6]' 'position_m = [500020, 5200020]' 'rocks = 5' \
  'height_scatter_m = 1' 'velocity_scatter_m_s = 0.5'
for sample in 1 2 1; do
  expect 0 blocks --overwrite --sample $sample --report r$sample.json
  cp blocks.h5 again_$sample.h5
  [ $sample = 2 ] || { [ ! -f first.h5 ] && cp blocks.h5 first.h5; }
done
cmp first.h5 again_1.h5 || fail 'one sample gives two sets of rocks'
cmp -s first.h5 again_2.h5 && fail 'another sample draws the same rocks'

# Implausible values are refused.
rocks 'shape = "box"' 'size_m = [1]' 'position_m = [500020, 5200020]' '[solver]' 'blocks = "together"'
expect 1 blocks --overwrite
says 'rocks of [rockfall.*] fall one by one'
rocks 'shape = "box"' 'size_m = [1]' 'position_m = [500020, 5200020]' '[source]' "$area"
expect 1 blocks --overwrite
says '[source] is cut into blocks that move together'
rocks 'shape = "box"' 'size_m = [1]' 'position_m = [500020, 5200020]' 'frequency_per_m2_a = 0.1'
expect 1 blocks --overwrite
says 'do not stand for an area'
