# A slope with three boxes as talus-batch takes it, and stand-ins for tools: read by the tests beside it.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_inputs
sed -i 's/^duration_s = .*/duration_s = 0.5\nstart_jitter_m_s = 0.1/' site.toml
mkdir results
mv slope.tif results/bed.tif
mv blocks.h5 results/blocks.h5
# batch ARGUMENTS...
batch() { talus-batch site.toml --results results --no-db "$@"; }
# stand_in TOOL: its script, read from standard input, is taken by --launcher "$PWD/tools/"
stand_in() {
  if [ ! -d tools ]; then
    mkdir tools
    for tool in "${bin%%:*}"/talus-*; do [ ! -f "$tool" ] || ln -s "$tool" tools; done
  fi
  rm "tools/$1"
  { echo '#!/bin/sh' && cat && echo "exec ${bin%%:*}/$1 \"\$@\""; } >"tools/$1"
  chmod +x "tools/$1"
}
# outcomes [FOLDER]: of its members, in order
outcomes() {
  python3 -c 'import json, sys
print(",".join(m["outcome"] for m in json.load(open(sys.argv[1] + "/ensemble.json"))["members"]))' "${1:-results/runs}"
}
# made_again N ARGUMENTS...: so many runs are made
run_files() { find results -name 'run_*.h5' -exec stat -c '%i %n' {} + | sort; }
made_again() {
  expected_runs=$1
  shift
  run_files >before
  expect 0 batch "$@"
  n=$(run_files | comm -13 before - | wc -l)
  [ "$n" -eq "$expected_runs" ] || fail "$n runs were made, expected $expected_runs: $*"
}
