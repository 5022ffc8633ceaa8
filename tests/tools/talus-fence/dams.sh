# Helper of the tests of dams and galleries: a slope of 30 degrees down to the east, flat from 500100 on.
. "$source_dir/tests/tools/talus-dda/common.sh"
command -v python3 >/dev/null || skip "needs python3"
make_terrain
# compute NAME OPTIONS: terrain with the dams of the site, rocks and a run, in the folder NAME
compute() {
  name=$1
  shift
  mkdir -p $name
  expect 0 talus-trn slope.tif site.toml "$@" -o $name/trn.tif --cell-size-m 0.5 --report $name/trn.json --no-db
  expect 0 talus-blocks site.toml "$@" --trn $name/trn.tif -o $name/blocks.h5 --trn-out $name/bed.tif --no-db
  expect 0 talus-dda site.toml "$@" --trn $name/bed.tif --blocks $name/blocks.h5 -o $name/run_1.h5 --no-db
}
