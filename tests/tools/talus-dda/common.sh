# A slope of 30 degrees that runs out on a flat, three boxes on it, a line across: read by the tests
# beside it. Leaves slope.tif, blocks.h5 and site.toml.

# plane.asc: nodes 5 m apart, 31 columns by 21 rows, down to the east, flat beyond 100 m
make_terrain() {
  awk 'BEGIN {
    print "ncols 31\nnrows 21\nxllcenter 500000\nyllcenter 5000000\ncellsize 5\nNODATA_value -9999"
    for (r = 0; r < 21; r++) {
      line = ""
      for (c = 0; c < 31; c++) {
        x = 5 * c
        line = line " " sprintf("%.6f", 1000 - (x < 100 ? x : 100) * 0.5773502691896257)
      }
      print line
    }
  }' >plane.asc
  talus-trn plane.asc -o slope.tif --crs EPSG:32632 -q --no-db
}

make_site() {
  cat >site.toml <<'END'
[site]
name = "test slope"
[material.rock]
density_kg_m3 = 2600
[ground.ground]
friction_deg = 20
cor = 0.4
[blocks.a]
shape = "box"
size_m = [2, 1.5, 1]
position_m = [[500020, 5000030], [500021, 5000050], [500022, 5000070]]
height_above_ground_m = 0.5
spin_rad_s = [0.3, 1, 0.2]
[fence.low]
line = [[500060, 5000010], [500060, 5000090]]
active = false
[solver]
duration_s = 8
max_lost_share = 1
END
}

make_blocks() { talus-blocks site.toml --trn slope.tif -o blocks.h5 -q --no-db; }

make_inputs() {
  make_terrain
  make_site
  make_blocks
}

run_dda() { talus-dda site.toml --trn slope.tif --blocks blocks.h5 --no-db --set solver.blocks=alone "$@"; }
