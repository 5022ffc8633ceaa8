# Three boxes that slide to a house below, and the fences that may be built: read by the tests
# beside it.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_search() {
  make_terrain
  make_site
  sed -i -e '/^\[fence.low\]/,/^active/d' -e 's/^duration_s = .*/duration_s = 11\nfriction_scatter_deg = 2/' site.toml
  cat >>site.toml <<'END'
[object.house]
polygon = [[500085, 5000025], [500095, 5000025], [500095, 5000075], [500085, 5000075]]
[fence_search.house]
protect = "house"
style = "offset"
between_m = [10, 40]
step_m = 10
max_ground_slope_deg = 40
END
  make_blocks
}
# runs NAME FIRST LAST OPTIONS...: NAME_SEED.h5
runs() {
  name=$1 first=$2 last=$3
  shift 3
  for seed in $(seq "$first" "$last"); do
    expect 0 run_dda --seed "$seed" -o "${name}_$seed.h5" "$@"
  done
}
search() { talus-fence-search site.toml --trn slope.tif --no-db "$@"; }
