#!/bin/sh
# With which settings the runs in place were made. The files in FOLDER hold a line a run, KEY SEAL RUN:
# KEY stands for the settings (dda.mk), SEAL, the digest at the end of a run file, for its content.
#   made_with.sh note FOLDER/FILE KEY RUN MARK        adds the line of RUN if it has a result (run_outcomes.sh)
#   made_with.sh others FOLDER [KEY PATTERN]...       prints the runs of each PATTERN that are there and not known
#                                                     to be made with KEY
set -eu
seals() { xargs -r -d '\n' tail -v -c 64 -- 2>/dev/null; }

case $1 in
  note)
    file=$2 key=$3 run=$4 mark=$5
    [ -f "$run" ] || exit 0
    if [ -f "$mark" ] && ! grep -q '^kept' "$mark"; then exit 0; fi
    mkdir -p "${file%/*}"
    echo "$key $(tail -c 64 "$run") $run" >>"$file"
    ;;
  others)
    folder=$2 wanted=$(mktemp)
    shift 2
    trap 'rm -f "$wanted"' EXIT
    while [ $# -gt 0 ]; do
      for run in $2; do [ ! -f "$run" ] || echo "$1 $run"; done
      shift 2
    done >"$wanted"
    [ -s "$wanted" ] || exit 0
    cut -d' ' -f2 "$wanted" | seals | awk '
      what == "noted" { is_noted[$1, $2, $3]; next }
      what == "wanted" { key[$2] = $1; next }
      {
        head = match($0, /==> .* <==$/)  # of the next file, behind the seal where another tail begins
        if (run in key && (key[run], head ? substr($0, 1, head - 1) : $0, run) in is_noted) delete key[run]
        if (head) run = substr($0, head + 4, length($0) - head - 7)
      }
      END { for (run in key) print run }' what=noted $(find "$folder" -type f 2>/dev/null) what=wanted "$wanted" what=sealed -
    ;;
esac
