#!/bin/sh
# Parts of runs (talus-reduce), each with a list of what it holds: PART.runs beside PART.h5 keeps the size and the
# time of change of the part and of each of its runs. A part counts that is still what its list says, with its runs.
#   reduce.sh make PART.h5 MARKS LIST COMMAND...  by COMMAND, of those runs of LIST that have a result (run_outcomes.sh);
#                                                 nothing is done where such a part stands
#   reduce.sh valid FOLDER                        prints the lists of the parts in FOLDER, and in without/ there, that count
set -eu
state='%s %.9Y %n'

counts() {
  [ -f "$1" ] && cut -d' ' -f3- "$1" | xargs -d '\n' stat -c "$state" 2>/dev/null | cmp -s - "$1"
}

case $1 in
  valid)
    for list in "$2"/*.runs "$2"/without/*.runs; do
      if counts "$list"; then echo "$list"; fi
    done
    ;;
  make)
    part=$2 marks=$3 list=$4
    shift 4
    there=$list.there kept=${part%.h5}.runs
    sh "${0%/*}/run_outcomes.sh" results "$marks" --from "$list" >"$there"
    if [ ! -s "$there" ]; then
      rm -f "$kept" "$part"
      exit 0
    fi
    if counts "$kept" && sed 1d "$kept" | cut -d' ' -f3- | cmp -s - "$there"; then exit 0; fi
    mkdir -p "${part%/*}"
    "$@" --runs-from "$there" -o "$part" --overwrite
    # The list comes last: a part without it is none.
    fresh=$(mktemp "${kept%/*}/.${kept##*/}.part-$$-XXXXXX")
    chmod =rw "$fresh"
    { echo "$part"; cat "$there"; } | xargs -d '\n' stat -c "$state" >"$fresh"
    mv "$fresh" "$kept"
    ;;
esac
