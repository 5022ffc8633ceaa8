#!/bin/sh
# What became of the runs of a site. MARKS is a folder with a file a run that failed (talus-dda
# --failures): "kept" or "none", whether there is a result, and what failed.
#   run_outcomes.sh there  MARKS RUN...   options of a tool that evaluates: the runs that have a result
#   run_outcomes.sh results MARKS RUN...  prints the names of the runs that have a result, a line each
#   run_outcomes.sh some   MARKS RUN...   ends with 1, and with the list, when no run has a result
#   run_outcomes.sh ended  MARKS RUN...   ends with 1, and with the list, when a run has no result for no fault of its own
#   run_outcomes.sh failed MARKS RUN...   prints the names of the runs that failed
#   run_outcomes.sh list   MARKS RUN...   lists what failed in which run; ends with 1 when any did
# RUN may also be --from LIST, a file with a name a line; then `there` names lists of those that have a result.
# With the variable `parts`, a folder, `there` names parts of runs (reduce.sh) in place of the runs that they hold.
set -eu
what=$1 marks=$2
shift 2
tab=$(printf '\t')

runs= lists=
while [ $# -gt 0 ]; do
  case $1 in
    --from) runs="$runs $(cat "$2")" lists="$lists $2"; shift 2 ;;
    *) runs="$runs $1"; shift ;;
  esac
done
set -- $runs

# RUN is OUT/runs/run_3.h5 or OUT/without/run_3.h5: sets `name` and `mark`. A result that is newer than
# a mark came in place after it: its run was killed before it could take the mark away.
look_at() {
  name=${1##*/} name=${name%.h5}
  mark=$marks/$name
  case $1 in without/* | */without/*) mark=$marks/without_$name name=without/$name ;; esac
  if [ -f "$mark" ] && [ "$1" -nt "$mark" ] && ! grep -q '^kept' "$mark"; then rm -f "$mark"; fi
}
has_result() {
  [ -f "$1" ] || return 1
  [ -f "$mark" ] || return 0
  IFS=$tab read -r first rest <"$mark" && [ "$first" = kept ]
}

# Killed, asked to end, or never begun: it may well have a result when it is made again.
is_cut_off() {
  [ -f "$mark" ] || return 0
  grep -q "^none$tab.*\(did not end by itself\|interrupted\)" "$mark"
}

n=0 n_there=0 n_failed=0 n_cut_off=0 failed=
for run in "$@"; do
  n=$((n + 1))
  look_at "$run"
  if has_result "$run"; then
    n_there=$((n_there + 1))
  fi
  if [ -f "$mark" ] || [ ! -f "$run" ]; then
    n_failed=$((n_failed + 1)) failed="$failed $run"
    has_result "$run" || ! is_cut_off || n_cut_off=$((n_cut_off + 1))
  fi
done

results() {
  for run in "$@"; do
    look_at "$run"
    if has_result "$run"; then echo "$run"; fi
  done
}

# Of names of runs, a line each, those that parts hold are replaced by these parts. One that holds another run, or one
# that was made again since, does not count.
in_parts() {
  [ -n "${parts:-}" ] || { cat; return; }
  awk '
    !is_run && FNR == 1 { part[++n] = $3; next }
    !is_run { held[n, ++n_held[n]] = $3; next }
    { run[++m] = $1; is_wanted[$1] = 1 }
    END {
      for (p = 1; p <= n; ++p) {
        fits = n_held[p] > 0
        for (r = 1; r <= n_held[p]; ++r) if (!(held[p, r] in is_wanted)) fits = 0
        if (!fits) continue
        print part[p]
        for (r = 1; r <= n_held[p]; ++r) delete is_wanted[held[p, r]]
      }
      for (r = 1; r <= m; ++r) if (run[r] in is_wanted) print run[r]
    }' $(sh "${0%/*}/reduce.sh" valid "$parts") is_run=1 -
}

# A list beside each that was given, replaced in one go: several tools may ask at a time.
print_lists() {
  for list in $lists; do
    new=$list.there
    [ -z "${parts:-}" ] || new=$list.in_parts
    fresh=$(mktemp "${new%/*}/.${new##*/}.part-$$-XXXXXX")
    chmod =rw "$fresh"
    results $(cat "$list") | in_parts >"$fresh"
    mv "$fresh" "$new"
    case $list in */without.list) echo "--without-from $new" ;; *) echo "--runs-from $new" ;; esac
  done
}

# Few failed runs are left out of what is made: up to the share `most_failed`, 0.02 unless given.
list() {
  used='its result is used, and marked'
  awk "BEGIN { exit ($n_failed > ${most_failed:-0.02} * $n) }" &&
    used='left out, and counted into the intervals'
  echo "$n_failed of $n runs failed:"
  for run in $failed; do
    look_at "$run"
    if [ -f "$mark" ]; then
      while IFS=$tab read -r outcome words; do
        case $outcome in
          kept) printf '  %s: %s (%s)\n' "$name" "$words" "$used" ;;
          none) printf '  %s: %s (no result)\n' "$name" "$words" ;;
        esac
      done <"$mark"
    else
      echo "  $name: was not computed"
    fi
  done
  for run in $failed; do
    look_at "$run"
    [ ! -f "$mark" ] || sed -n "s/^hint$tab/  hint: /p" "$mark"
  done | sort -u
  [ "$n_there" -gt 0 ] || echo "  no run has a result: there is nothing to evaluate"
}

case $what in
  there)
    if [ -z "$lists" ]; then
      # --without takes all that follows it, so what stands without fences comes last
      results "$@" | in_parts |
        awk '/(^|\/)without\// { last = last " --without " $0; next } { print } END { print last }' | tr '\n' ' '
    else
      print_lists
    fi
    [ "$n_there" -eq "$n" ] || echo --missing $((n - n_there))
    ;;
  results) results "$@" ;;
  some) [ "$n_there" -gt 0 ] || { list >&2; exit 1; } ;;
  ended) [ "$n_cut_off" -eq 0 ] || { list >&2; exit 1; } ;;
  failed) echo $failed ;;
  list) [ "$n_failed" -eq 0 ] || { list >&2; exit 1; } ;;
esac
