# Memory is asked for before it is taken: a need beyond --memory-mb is refused with the memory asked
# for, the limit, and a remedy, and leaves nothing.
lacks() { # lacks WORDS HINT COMMAND...
  words=$1 hint=$2
  shift 2
  expect 1 "$@" --memory-mb 5 --no-db
  says "$words"
  says " MB of memory, expected at most "
  says ", what --memory-mb leaves"
  says "hint: $hint, or give more with --memory-mb"
  nothing_left out.tif out.h5 out.ply
}
designed=$source_dir/sample_sites/designed
cp "$designed/site.toml" designed.toml

# terrains: an empty raster is small on the disk
gdal_create -q -of GTiff -outsize 12000 9000 -bands 1 -ot Float32 -a_srs EPSG:32633 -a_ullr 500000 5290000 620000 5200000 -co SPARSE_OK=TRUE large.tif
[ "$(wc -c <large.tif)" -lt 2000000 ] || fail "the raster is not small"
lacks "large.tif: 12000 x 9000 nodes need about 1728" "choose a larger cell or a smaller window" \
  talus-trn large.tif -o out.tif
lacks "large.tif: 12000 x 9000 nodes need" "choose a larger cell or a smaller window" \
  talus-blocks designed.toml --trn large.tif -o out.h5
# rows of a raster that a window takes few columns of
expect 1 talus-trn large.tif -o out.tif --window 500000,5200000,620000,5200100 --memory-mb 45 --no-db
says "rows of 12000 cells need about 50 MB"

# joint cells, and the frames of a run
cat >flat.asc <<'END'
ncols 30
nrows 30
xllcorner 500000
yllcorner 5200000
cellsize 4
END
awk 'BEGIN { for (r = 0; r < 30; r++) { for (c = 0; c < 30; c++) printf "%g ", 50 - r; print "" } }' >>flat.asc
expect 0 talus-trn flat.asc -o flat.tif --crs EPSG:32633 --no-db
cat >cut.toml <<'END'
[site]
name = "cut"
[source]
polygon = [[500030, 5200040], [500080, 5200040], [500080, 5200090], [500030, 5200090]]
depth_m = 5
max_blocks = 10000000
[joints.A]
dip_deg = 60
dip_direction_deg = 90
spacing_m = 1
[joints.B]
dip_deg = 70
dip_direction_deg = 180
spacing_m = 1
[solver]
duration_s = 2
END
lacks "cut.toml:6: " "widen the spacings" talus-blocks cut.toml --trn flat.tif -o out.h5
cat >box.toml <<'END'
[site]
name = "box"
[blocks.a]
shape = "box"
size_m = [1, 1, 1]
position_m = [500060, 5200080]
[solver]
duration_s = 2
END
expect 0 talus-blocks box.toml --trn flat.tif -o box.h5 --no-db
lacks "2e+04 frames of 1 block need about 13 MB" "set a longer frame_interval_s or a shorter duration_s" \
  talus-dda box.toml --trn flat.tif --blocks box.h5 -o out.h5 --set output.frame_interval_s=1e-4
expect 0 talus-dda box.toml --trn flat.tif --blocks box.h5 -o run.h5 --set output.frame_interval_s=0.1 --memory-mb 5 --no-db

# points of contours
expect 1 talus-tin "$designed/contours.gpkg" -o out.ply --elevation-field elevation_m --memory-mb 1 --no-db
says "contours.gpkg: triangles of 6148 points need about 2 MB of memory"
nothing_left out.ply

# the machine's own limit counts where none is given
(ulimit -v 1500000 && expect 1 talus-trn large.tif -o out.tif --no-db && says "what is free on this machine") ||
  skip "ulimit -v is too little here"
expect 2 talus-trn large.tif -o out.tif --memory-mb -1
