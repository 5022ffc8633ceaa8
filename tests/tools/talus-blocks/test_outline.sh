# The mass ends at the source polygon: its volume is area times depth for any cell size, and
# odd values are reported.
. "$source_dir/tests/tools/talus-blocks/scene.sh"

# slope.asc of 20 degrees down to the south, 240 m wide: make_plane CELL
make_plane() {
  awk -v cell="$1" 'BEGIN {
    n = 240 / cell + 1
    printf "ncols %d\nnrows %d\nxllcenter 500000\nyllcenter 5200000\ncellsize %g\n", n, n, cell
    for (r = 0; r < n; r++)
      for (c = 0; c < n; c++)
        printf "%.9f%s", 100 + 0.36397023426620 * cell * (n - 1 - r), c < n - 1 ? " " : "\n"
  }' >plane.asc
  gdal_translate -q -ot Float64 -a_srs EPSG:32633 plane.asc plane.tif
  talus-trn plane.tif -o trn.tif --overwrite --no-db -q
}

make_site
sed -i 's/spacing_m = .*/spacing_m = 15/; s/^depth_m = .*/depth_m = 10/' site.toml
# cut POLYGON OPTIONS...: exact blocks of it
cut() {
  polygon=$1
  shift
  blocks --exact --overwrite --report r.json --set source.min_block_volume_m3=0 \
    --set source.min_block_thickness_m=0 --set source.max_block_aspect=1e9 --set "source.polygon=$polygon" "$@"
}

# area of 3,000 m2, 10 m along the normal
on_nodes='[[500100,5200100],[500160,5200100],[500160,5200150],[500100,5200150]]'
beside='[[500103.7,5200101.3],[500163.7,5200101.3],[500163.7,5200151.3],[500103.7,5200151.3]]'
turned='[[500100,5200070],[500148,5200106],[500118,5200146],[500070,5200110]]'
for cell in 10 5 2.5; do
  make_plane "$cell"
  for polygon in "$on_nodes" "$beside" "$turned"; do
    expect 0 cut "$polygon"
    prism=$(awk 'BEGIN { printf "%.9g", 3000 * 10 / cos(20 * atan2(0, -1) / 180) }')
    holds "($(value r.json prism_volume_m3) / $prism - 1) ^ 2 < 1e-10"
    holds "(($(value r.json volume_m3) + $(value r.json slivers_left_out_m3)) / $prism - 1) ^ 2 < 1e-10"
    holds "($(value r.json mass_area_share) - 1) ^ 2 < 1e-12"
    prints "the mass covers 3,000 m2, 100 % of the polygon of 3,000 m2"
    if grep -q "warning" err; then fail "warns of a sound source: $(cat err)"; fi
  done
done

# a plane that comes out in the middle of the polygon leaves half of it without a mass
expect 0 cut "$on_nodes" --set source.failure_surface=plane --set source.plane_dip_deg=10 \
  --set source.plane_dip_direction_deg=180 --set 'source.plane_point_m=[500130,5200125,145.5]'
says "% of the source polygon: elsewhere the failure surface does not lie below the ground"
# a depth in feet, or a typing error
expect 0 cut "$on_nodes" --set source.depth_m=33
says "m deep on average, more than the relief of the ground over it"
