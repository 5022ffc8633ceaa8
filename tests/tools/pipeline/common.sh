# A short run of the designed site in a folder of its own: read by the tests beside it.
command -v make >/dev/null || skip "needs make"

# site FOLDER: site.toml, contours and Makefile; 0.5 s are simulated
site() {
  mkdir -p "$1"
  cp "$source_dir/sample_sites/designed/contours.gpkg" "$1/"
  sed 's/^duration_s = .*/duration_s = 0.5/' "$source_dir/sample_sites/designed/site.toml" >"$1/site.toml"
  echo "include $source_dir/pipelines/site.mk" >"$1/Makefile"
}
# variants FOLDER LINES: [variant.*] of its site file, in the place of those before; \n parts lines
variants() {
  sed -i '/^\[variant\./,$d' "$1/site.toml"
  printf "$2\n" >>"$1/site.toml"
}
# made FOLDER ARGUMENTS...: make with the tools on the search path
made() {
  folder=$1
  shift
  expect 0 make -C "$folder" BIN= "$@"
}
# same FOLDER FOLDER: all outputs byte by byte, but for the registry and memories, with
# their times and paths
same() {
  diff -r -q --exclude='runs.sqlite*' --exclude=.digests --exclude=.lock --exclude='.*.part-*' "$1/out" "$2/out" >differences ||
    { cat differences >&2; fail "the outputs of $1 and $2 differ"; }
}
# same_results FOLDER FOLDER: as `same`, but for files that shards leave: their registries and parts
same_results() {
  diff -r -q -x 'runs.sqlite*' -x .digests -x .lock -x shards -x parts -x ensemble.json -x '.*.part-*' "$1/out" "$2/out" >differences ||
    { cat differences >&2; fail "the results of $1, by shards, and of $2, by one make, differ"; }
}
# was_made_by FOLDER FILE TEXT: the command that made FILE holds TEXT
was_made_by() {
  talus-runs --db "$1/out/runs.sqlite" trace "$1/out/$2" | sed -n 2p >made_by
  grep -qF -e "$3" made_by || { cat made_by >&2; fail "$2 of $1 was not made by: $3"; }
}
# on_page FILES...: every field of these layers and tables has a title and is on the page of fields
on_page() {
  python3 "$source_dir/tests/tools/fields.py" "$source_dir/docs/reference/fields.md" "$@" || fail "fields"
}
