#!/bin/sh
# clean.sh OUT MARK PATTERNS FOLDERS: removes from OUT the files of the pipeline: those by PATTERNS
# (one argument, parted by blanks), then MARK, then FOLDERS (patterns too) and OUT where these are
# empty. Without MARK the pipeline made none of the files in OUT, and all stay. A file that
# site.toml names stays, whatever its name. Lists the files that stay.
set -eu
out=$1 mark=$2 patterns=$3 folders=$4
[ -d "$out" ] || exit 0
if ! grep -q '^# written by talus-site' "$out/$mark" 2>/dev/null; then
  echo "clean: $out holds nothing that the pipeline made: all of it stays"
  exit 0
fi
# Of the texts in site.toml those that are files in OUT, a line each; no tool is needed for it.
inputs=$([ ! -f site.toml ] || grep -o "\"[^\"]*\"\|'[^']*'" site.toml |
  sed 's/^.//; s/.$//; s/|.*//' |
  while read -r name; do
    case $(realpath -- "$name" 2>/dev/null) in
      "$(realpath "$out")"/*) [ ! -f "$name" ] || printf '%s\n' "$name" ;;
    esac
  done)
is_input() {
  [ -n "$inputs" ] || return 1
  while read -r name; do
    if [ "$name" -ef "$1" ]; then return 0; fi
  done <<END
$inputs
END
  return 1
}
set -f  # patterns are of OUT, not of the folder that make runs in
set -- $patterns "$mark"
set +f
for pattern; do
  for file in "$out"/$pattern; do
    if is_input "$file"; then continue; fi
    case $pattern in
      *.part-*) rm -rf -- "$file" ;;  # the folder of a tool that was killed
      *) [ -d "$file" ] || rm -f -- "$file" ;;
    esac
  done
done
set -f
set -- $folders
set +f
for folder; do
  for path in "$out"/$folder; do
    [ -d "$path" ] && rmdir -- "$path" 2>/dev/null || true
  done
done
rmdir -- "$out" 2>/dev/null && exit 0
echo "clean: not made by the pipeline, so left in $out:" $(cd "$out" && ls -A)
