#!/bin/sh
# The proposals of talus-fence-search in the folder SEARCH.
#   proposals.sh take SEARCH VERIFY        from SEARCH/new: those that changed replace the old ones, whose runs in VERIFY
#                                          then are of another fence; those that are no more go
#   proposals.sh names SEARCH              prints their names
#   proposals.sh verified SEARCH NAME...   prints options of the tool for the runs of SEARCH/NAME.list that are there
set -eu
what=$1 search=$2
shift 2

names() {
  for file in "$search"/*.toml; do
    [ ! -f "$file" ] || { name=${file##*/}; echo "${name%.toml}"; }
  done
}

case $what in
  take)
    for name in $(names); do
      [ -f "$search/new/$name.toml" ] || rm -f -- "$search/$name.toml" "$search/$name.list" "$search/$name.list.there"
    done
    for file in "$search"/new/*.toml; do
      [ -f "$file" ] || continue
      cmp -s "$file" "$search/${file##*/}" || cp "$file" "$search/${file##*/}"
      rm -f -- "$file"
    done
    rmdir -- "$search/new" 2>/dev/null || true
    ;;
  names) echo $(names) ;;
  verified)
    for name; do
      while read -r run; do [ ! -f "$run" ] || echo "$run"; done <"$search/$name.list" >"$search/$name.list.there"
      [ ! -s "$search/$name.list.there" ] || echo "--verified $name=@$search/$name.list.there"
    done
    ;;
esac
