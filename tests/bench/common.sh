# What the shell benchmarks on gschnitz_gar share, read by them: their first argument is the folder of
# the executables. Sets source_dir, bin, data and work (an emptied folder, removed at the end), goes to
# `work` and makes its terrain there (trn.tif). Skips where ../shared/data is not there.
set -euo pipefail
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
bin=$(cd "${1:-$source_dir/build/release/tools}" && pwd)
data=$source_dir/../shared/data
[ -d "$data" ] || { echo "skipped: $data is not there"; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
make -s -C "$source_dir/sample_sites/gschnitz_gar" terrain BIN="$bin/" OUT="$work" >/dev/null
cd "$work"
