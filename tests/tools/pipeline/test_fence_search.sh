# make fence-search: runs are screened, proposals are tried in other runs, the report says both;
# clean takes all away.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v talus-fence-search >/dev/null || skip "needs the tools of this checkout"
mkdir s
(cd s && . "$source_dir/tests/tools/talus-fence-search/common.sh" && make_search >/dev/null && rm -f slope.tif blocks.h5)
sed -i -e 's/^name = .*/name = "slope"\ncrs = "EPSG:32632"\n[terrain]\ndem = "plane.asc"\ncell_size_m = 5/' \
  -e 's/^duration_s = .*/duration_s = 11\nn_runs = 10\nblocks = "alone"/' -e 's/^spin_rad_s.*//' s/site.toml
printf '%s\n' 'TRN_FLAGS = --crs EPSG:32632' 'SEARCH_FLAGS = --n-proposals 1' \
  "include $source_dir/pipelines/site.mk" >s/Makefile
made s -j2 fence-search report
[ "$(find s/out/verify/house-1 -name 'run_*.h5' | wc -l)" = 10 ] || fail "$(find s/out/verify)"
[ -f s/out/verify/house-1/run_11.h5 ] || fail 'the seeds after those of the search do not verify'
grep -q '"comparison": "as predicted"' s/out/fence_search.json || fail 'nothing was verified'
on_page s/out/fence_search.gpkg
for words in 'Where a fence belongs' 'house-1' 'as predicted' 'cost against what is let through'; do
  grep -q "$words" s/out/report.html || fail "the report does not say: $words"
done
made s -j2 fence-search report
prints 'Nothing to be done'

# other prices, the same fence: no run is made again
cp s/out/search/house-1.toml before.toml
touch mark
sed -i 's/^protect/price_per_m2 = 0.2\nprotect/' s/site.toml
made s -j2 fence-search
[ -z "$(find s/out/runs -name '*.h5' -newer mark)" ] || fail 'prices make the runs of the search again'
if cmp -s before.toml s/out/search/house-1.toml; then
  [ -z "$(find s/out/verify -name "*.h5" -newer mark)" ] || fail "the same fence stands in new runs"
fi

# where no fence is enough there is no proposal, and the one before goes
sed -i 's/^protect/max_length_m = 5\nprotect/' s/site.toml
made s -j2 fence-search VERIFY_RUNS=0
prints 'house: house is hit in 10 of 10 runs; no fence of this kind'
[ ! -e s/out/search/house-1.toml ] && [ ! -e s/out/search/new ] || fail "left: $(find s/out/search)"
made s clean
[ ! -e s/out ] || fail "left: $(find s/out)"
