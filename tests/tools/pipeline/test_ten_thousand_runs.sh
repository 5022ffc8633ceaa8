# Ten thousand runs: make splits them into jobs, and knows within seconds which are missing.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
many='RUNS=10000 WITHOUT=no'
# shellcheck disable=SC2086  # words of make
made slope $many prepare
prints "runs: 10000 to make"
# shellcheck disable=SC2086
made slope -n $many SHARDS=300 submit
prints "--array=1-300 "
variants slope '[variant.V1]\nweight = 1\n[variant.V2]\nweight = 1'
# shellcheck disable=SC2086
made slope -n $many SHARDS=300 submit
prints "--array=1-300 "
