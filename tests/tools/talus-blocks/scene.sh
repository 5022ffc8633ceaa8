# scene.sh: read by the tests of talus-blocks; makes a terrain and a site file in the test's folder.
# slope.asc: 24 x 24 nodes, 2 m apart, 40 degrees down to the south, in EPSG:32633.
make_slope() {
  awk 'BEGIN {
    printf "ncols 24\nnrows 24\nxllcenter 500000\nyllcenter 5200000\ncellsize 2\nNODATA_value -9999\n"
    for (r = 0; r < 24; r++)
      for (c = 0; c < 24; c++)
        printf "%.3f%s", 100 + 0.84 * 2 * (23 - r) + 0.1 * sin(c) * cos(r), c < 23 ? " " : "\n"
  }' >slope.asc
  gdal_translate -q -ot Float64 -a_srs EPSG:32633 slope.asc dem.tif
  talus-trn dem.tif -o trn.tif --no-db -q
}

# make_site EXTRA...: a whole site file; each EXTRA is a line added at its end
make_site() {
  cat >site.toml <<'SITE'
[site]
crs = "EPSG:32633"

[source]
polygon = [[500012, 5200012], [500034, 5200012], [500034, 5200034], [500012, 5200034]]
failure_surface = "normal_depth"
depth_m = 4

[joints.sliding]
dip_deg = 35
dip_direction_deg = 180
spacing_m = 3

[joints.rear]
dip_deg = 80
dip_direction_deg = 10
spacing_m = 4

[joints.lateral]
dip_deg = 85
dip_direction_deg = 95
spacing_m = 4

[material.rock]
SITE
  for line in "$@"; do printf '%s\n' "$line" >>site.toml; done
}

blocks() { talus-blocks site.toml --trn trn.tif -o blocks.h5 --no-db "$@"; }

# value FILE KEY: the first number of that name in a JSON report
value() { sed -n "s/.*\"$2\": \([-0-9.e+]*\),*$/\1/p" "$1" | head -n 1; }

# holds EXPRESSION: an awk expression is true
holds() { awk "BEGIN { exit !($1) }" || fail "not true: $1"; }

command -v gdal_translate >/dev/null || skip "needs gdal-bin"
make_slope
