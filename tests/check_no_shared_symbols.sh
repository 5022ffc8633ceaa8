#!/bin/sh
# check_no_shared_symbols.sh OBJECT...: none of the objects defines a symbol that the linker may take
# for another file's copy of the same inline function.
set -eu
[ $# -gt 0 ] || { echo "no object given"; exit 1; }
for object in "$@"; do
  if nm -C "$object" | grep ' [uVvWw] '; then
    echo "$object: shares these symbols with other files; keep them inline, or local to it"
    exit 1
  fi
done
