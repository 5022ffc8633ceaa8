# Searches that cannot be made are refused with their section and a remedy; so are runs that do not
# fit.
. "$source_dir/tests/tools/talus-fence-search/common.sh"
make_search
cp site.toml good.toml
runs run 1 2
# refused SED WORDS WAY_OUT: of the search, and of the run that would watch its lines
refused() {
  sed "$1" good.toml >site.toml
  expect 1 search run_1.h5 -o s.gpkg
  says "$2"
  says "$3"
  expect 1 run_dda -o bad.h5
  says "$2"
  nothing_left s.gpkg bad.h5
}
refused 's/^between_m.*/between_m = [60, 20]/' 'there is no room between these' 'the nearest distance from the object first'
sed '/^\[fence_search/,$d' good.toml >site.toml
expect 1 search run_1.h5 -o s.gpkg
says 'has no section [fence_search.*]'

# runs that did not watch these lines, or watched other ones
cp site.toml without.toml
expect 0 talus-dda without.toml --trn slope.tif --blocks blocks.h5 --no-db --set solver.blocks=alone --set solver.duration_s=1 -o blind.h5
cp good.toml site.toml
expect 1 search blind.h5 -o s.gpkg
says 'did not watch the candidate lines of fence_search.house'
says 'run talus-dda again'
sed -i 's/^between_m.*/between_m = [12, 40]/' site.toml
expect 1 search run_1.h5 -o s.gpkg
says 'in another place than it has now'
cp good.toml site.toml
expect 1 search run_1.h5 -o s.gpkg --search hause
says 'did you mean house?'

# verifying runs: of the search itself, without the fence, of no proposal
expect 0 search run_1.h5 run_2.h5 -o s.gpkg --proposals p
says 'too few'
runs other 11 11
expect 1 search run_1.h5 run_2.h5 -o v.gpkg --verified house-1=run_1.h5
says 'verify with other seeds'
runs same 1 1 --add p/house-1.toml
expect 1 search run_1.h5 run_2.h5 -o v.gpkg --verified house-1=same_1.h5
says 'has seed 1, as has one of the runs'
expect 1 search run_1.h5 run_2.h5 -o v.gpkg --verified house-1=other_11.h5
says 'did not have fence house-1 standing where it is now'
expect 1 search run_1.h5 run_2.h5 -o v.gpkg --verified house-9=other_11.h5
says 'which is not a proposal of these runs'
expect 2 search run_1.h5 -o v.gpkg --verified house-1
says 'expected NAME=FOLDER or NAME=FILE'
nothing_left v.gpkg
