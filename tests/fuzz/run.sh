#!/bin/sh
# Fuzzes every parser under address and undefined sanitizers (clang, libFuzzer).
#   sh tests/fuzz/run.sh [SECONDS] [PARSER...]     default: 600 seconds each, all parsers
#   sh tests/fuzz/run.sh [SECONDS] command_lines   random command lines for the tools of preset dev
# New inputs go to build/fuzz/corpus; one that crashes to build/fuzz/crash-*, and the exit code is 1.
# Worth keeping: ./fuzz_X -merge=1 tests/fuzz/corpus/X build/fuzz/corpus/X
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-600}
[ $# -eq 0 ] || shift
parsers=${*:-$(ls tests/fuzz/corpus)}
if [ "$parsers" = command_lines ]; then
  cmake --preset dev >/dev/null
  cmake --build --preset dev --target tools/all run-probe
  exec python3 tests/fuzz/command_lines.py --bin "$PWD/build/dev/tools:$PWD/build/dev/tests" --source "$PWD" \
    --work build/command_lines --seconds "$seconds" --seed "$(date +%s)"
fi
cmake --preset fuzz >/dev/null
# shellcheck disable=SC2046,SC2086
cmake --build --preset fuzz --target $(printf 'fuzz_%s ' $parsers)
# words of the site file, which chance would not find
page=docs/reference/site-file.md
{ sed -n 's/^### \(\[[a-z_]*\).*/"\1"/p' $page
  sed -n 's/^| \(`[^|]*`\) |.*/\1/p' $page | tr -d '`,' | xargs -n 1 printf '"%s = "\n'; } >build/fuzz/site.dict
failed=0
for parser in $parsers; do
  mkdir -p "build/fuzz/corpus/$parser"
  "build/fuzz/tests/fuzz/fuzz_$parser" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 \
    -artifact_prefix="build/fuzz/crash-$parser-" -print_final_stats=1 -verbosity=0 \
    $([ "$parser" != site ] || echo -dict=build/fuzz/site.dict) \
    "build/fuzz/corpus/$parser" "tests/fuzz/corpus/$parser" || failed=1
  echo "fuzz_$parser: done"
done
exit $failed
