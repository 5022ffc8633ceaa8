#!/bin/sh
# run_case.sh SCRIPT BIN WORK SOURCE: one test of an executable, in an emptied folder of its own.
# SCRIPT is read by this shell with the helpers below; it may exit 77 to be skipped, saying why.
set -eu
script=$1 bin=$2 work=$3 source_dir=$4
shared_data=$source_dir/../shared/data
PATH=$bin:$PATH
export PATH
rm -rf "$work"
mkdir -p "$work"
cd "$work"

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

skip() {
  printf 'skipped: %s\n' "$*"
  exit 77
}

# expect CODE COMMAND...: run it, keep its output in `out` and `err`, compare its exit code
expect() {
  expected=$1
  shift
  code=0
  "$@" >out 2>err || code=$?
  if [ "$code" -ne "$expected" ]; then
    printf '%s\n' "$*" >&2
    sed 's/^/  out: /' out >&2
    sed 's/^/  err: /' err >&2
    fail "exit code $code, expected $expected"
  fi
}

# whole_lines FILE: with lines that were parted behind a semicolon as they were
whole_lines() { sed -e ':next' -e '/;$/{N' -e 's/;\n  /; /' -e 't next' -e '}' "$1"; }
# says TEXT: standard error of the last command holds TEXT
says() { whole_lines err | grep -qF -- "$1" || { sed 's/^/  err: /' err >&2; fail "standard error does not say: $1"; }; }
# prints TEXT: standard output of the last command holds TEXT
prints() { whole_lines out | grep -qF -- "$1" || { sed 's/^/  out: /' out >&2; fail "standard output does not say: $1"; }; }
# cell FILE BAND COLUMN ROW: the value of a cell, its nodata number too
cell() { gdal_translate -q -of XYZ -b "$2" -srcwin "$3" "$4" 1 1 "$1" /vsistdout/ | cut -d' ' -f3; }
# nothing_left PATTERN...: no such file, and no temporary one
nothing_left() {
  for name in "$@"; do [ ! -e "$name" ] || fail "$name was left behind"; done
  [ -z "$(find . -name '*.part*')" ] || fail "temporary files were left behind: $(find . -name '*.part*')"
}

. "$script"
