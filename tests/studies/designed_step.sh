#!/bin/sh
# designed_step.sh [BIN [OUT]]: which time step the designed slide needs, without its fence: its first 2 s,
# and its 20 s with law paper beside. Prints the tables of docs/evidence/measurements.md; OUT/first and OUT/whole hold
# the diagrams and the settings found. BIN: folder of the executables.
set -eu
cd "$(dirname "$0")/../.."
bin=$(cd "${1:-build/release/tools}" && pwd) out=${2:-$(mktemp -d)}
mkdir -p "$out"
site=sample_sites/designed
make -s -C "$site" BIN="$bin/" OUT="$out" blocks >"$out/log" 2>&1 || { cat "$out/log" >&2; exit 1; }
# study NAME DURATION_S [OPTION]: the table of a copy of the site that runs so long
study() {
  sed "s/^duration_s.*/duration_s = $2/; s/^active = true/active = false/" "$site/site.toml" >"$out/$1.toml"
  "$bin/talus-verify" --site "$out/$1.toml" --trn "$out/bed.tif" --blocks "$out/blocks.h5" --runs 2 -o "$out/$1" --overwrite ${3-}
}
study first 2
study whole 20 --paper
