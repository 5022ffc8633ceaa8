# Shards as jobs of Snakemake (pipelines/shards.smk), to the bytes of one make; a second time it changes nothing.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v snakemake >/dev/null || skip "needs snakemake (Debian package snakemake)"
snakemake --version >/dev/null 2>&1 || skip "snakemake does not start here"
site slope
by_snakemake() {
  expect 0 env HOME="$PWD" snakemake -s "$source_dir/pipelines/shards.smk" -d slope --cores 2 --nolock \
    --config shards=3 make="RUNS=5 WITHOUT=no BIN=" goals="maps runout"
}
by_snakemake
site whole
made whole RUNS=5 WITHOUT=no -j2 maps runout
same_results slope whole
was_made_by slope maps/reach.tif "talus-maps out/runs --trn"
expect 0 talus-runs --db slope/out/runs.sqlite list --summary
grep -q '^talus-dda  *5  *0 ' out || fail "the registry: $(cat out)"
[ -z "$(find slope/out/shards -name '*.ended')" ] || fail "marks of Snakemake are left"
by_snakemake
same_results slope whole
expect 0 talus-runs --db slope/out/runs.sqlite list --summary
grep -q '^talus-dda  *5  *0 ' out || fail "runs were made again: $(cat out)"
