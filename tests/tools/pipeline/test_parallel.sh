# The lines of docs/reference/pipeline.md for GNU parallel: shards as its jobs, to the bytes of one make.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v parallel >/dev/null || skip "needs GNU parallel (Debian package parallel)"
parallel --version 2>/dev/null | grep -q '^GNU parallel' || skip "needs GNU parallel, and this parallel is another one"
few='RUNS=5 WITHOUT=no BIN='
site slope
# shellcheck disable=SC2086  # words of make
{
  expect 0 make -C slope $few prepare
  expect 0 parallel --will-cite -j2 --halt now,fail=1 make -C slope $few SHARD={} SHARDS=3 runs-shard ::: 1 2 3
  expect 0 make -C slope $few maps runout
}
site whole
# shellcheck disable=SC2086
made whole $few -j2 maps runout
same_results slope whole
was_made_by slope maps/reach.tif "talus-maps out/runs --trn"
