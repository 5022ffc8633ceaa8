# A short run of the designed site in a folder of its own: read by the tests beside it.
command -v make >/dev/null || skip "needs make"

# site FOLDER: site.toml, contours and Makefile; 0.5 s are simulated
site() {
  mkdir -p "$1"
  cp "$source_dir/sample_sites/designed/contours.gpkg" "$1/"
  sed 's/^duration_s = .*/duration_s = 0.5/' "$source_dir/sample_sites/designed/site.toml" >"$1/site.toml"
  echo "include $source_dir/pipelines/site.mk" >"$1/Makefile"
}
# made FOLDER ARGUMENTS...: make with the tools on the search path
made() {
  folder=$1
  shift
  expect 0 make -C "$folder" BIN= "$@"
}
# same FOLDER FOLDER: all outputs byte by byte, but for the registry and the memory of digests, with
# their times and paths
same() {
  diff -r -q --exclude='runs.sqlite*' --exclude=.digests --exclude='.*.part-*' "$1/out" "$2/out" >differences ||
    { cat differences >&2; fail "the outputs of $1 and $2 differ"; }
}
