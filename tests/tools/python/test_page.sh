# The studies of docs/guide/python.md, as they are printed, on runs with a known answer: boxes that
# slide down a plane of 30 degrees.
. "$source_dir/tests/tools/talus-dda/common.sh"
python=/usr/bin/python3
$python -c 'import h5py, matplotlib, netCDF4, pandas, xarray' ||
  fail "python3-h5py, -matplotlib, -netcdf4, -pandas or -xarray is missing: sh pipelines/install_packages.sh test"

make_terrain
make_site
sed -i 's/^height_above.*/height_above_ground_m = 0.02/; /^spin/d; s/^duration_s = 8/duration_s = 7/' site.toml
cat >>site.toml <<'END'
[uncertainty]
sampling = "sobol"
[uncertainty.friction]
keys = ["ground.ground.friction_deg"]
distribution = "uniform"
min = 15
max = 25
END
mkdir -p site/out  # the helpers write to files `out` and `err`
cp slope.tif site/out/bed.tif
talus-blocks site.toml --trn slope.tif -o site/out/blocks.h5 -q --no-db
expect 0 talus-batch site.toml --results site/out --runs 6 --jobs 2 --no-db -- --set solver.blocks=alone --settle
[ -s site/out/runs/run_6.h5 ] || fail "no runs"

PYTHONPATH=$source_dir/python MPLBACKEND=Agg \
  expect 0 $python "$source_dir/tests/tools/python/run_page.py" "$source_dir/docs/guide/python.md" site
prints "rank correlation -1.00 from 6 runs"
[ -s site/reach.png ] && [ -s site/crossings.csv ] || fail "no picture or no table"
if Rscript -e 'library(rhdf5)' >/dev/null 2>&1; then
  awk '/^```r$/ { on = 1; next } /^```/ { on = 0 } on' "$source_dir/docs/guide/python.md" >page.R
  expect 0 sh -c "cd site && Rscript ../page.R"
  prints "Median"
else
  echo "The lines in R were not executed: they need r-base-core and r-bioc-rhdf5."
fi

# a file that is not a run is refused with its name
PYTHONPATH=$source_dir/python expect 1 $python -c 'import talus; talus.open_run("site/out/blocks.h5")'
says "site/out/blocks.h5: is of the format talus-blocks, expected talus-run"
PYTHONPATH=$source_dir/python expect 1 $python -c 'import talus; talus.open_ensemble("site")'
says "site/ensemble.json: is not there"
exit 0
