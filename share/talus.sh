#!/bin/sh
# talus: one command over the tools of Talus and the pipeline that drives them (docs/tools/talus.md).
set -eu
here=$(dirname "$(realpath "$0")")
refuse() { echo "talus: $1" >&2; exit 2; }

pipelines_folder() {
  for folder in "$here/../share/talus/pipelines" "$here/../../../pipelines"; do
    if [ -f "$folder/site.mk" ]; then realpath "$folder"; return; fi
  done
  refuse "there is no pipelines folder in $here/../share/talus: install Talus again"
}

# What each tool says of itself in its first line.
list_of_commands() {
  cat <<'END'
talus run [SITE] [GOAL | VARIABLE=VALUE | -OPTION]...   make in the folder of a site, here by default
talus new FOLDER GROUND [SOURCE] [ROCKFALL=yes]         a folder for another slope
talus help [run | new | TOOL]                           how a command is used
talus TOOL [ARGUMENT]...                                the same as talus-TOOL

Tools:
END
  for tool in "$here"/talus-*; do
    if [ -f "$tool" ] && [ -x "$tool" ]; then
      printf '  %-13s %s\n' "${tool##*/talus-}" "$("$tool" --help | head -n 1)"
    fi
  done
}

run() {
  site=.
  case ${1:-} in
    '' | -* | *=*) ;;
    *) if [ -d "$1" ]; then site=$1; shift; fi ;;
  esac
  [ -f "$site/site.toml" ] || refuse "$(realpath "$site") has no site.toml: give the folder of a site \
(talus run SITE), or make one (talus new FOLDER GROUND)"
  rules=Makefile
  [ -f "$site/Makefile" ] || rules=$(pipelines_folder)/site.mk
  exec make --no-print-directory -C "$site" -f "$rules" -j"$(nproc)" BIN="$here/" "$@"
}

new() {
  rockfall=
  for word; do
    shift
    case $word in
      ROCKFALL=*) rockfall=${word#ROCKFALL=} ;;
      *) set -- "$@" "$word" ;;
    esac
  done
  [ $# -eq 2 ] || [ $# -eq 3 ] || refuse "new takes a folder, the ground and, where there is one, the \
release polygon: talus new my_slope dem.tif release.gpkg"
  pipelines=$(pipelines_folder)
  exec sh "$pipelines/new_site.sh" "$1" "$2" "${3:-}" "$pipelines" "$here/" "$rockfall"
}

help() {
  pipelines=$(pipelines_folder)
  case ${1:-} in
    '') list_of_commands ;;
    run) exec make --no-print-directory -f "$pipelines/site.mk" help ;;
    new) sed -n '/^# new_site/,/^[^#]/{s/^# new_site.*: /talus new FOLDER GROUND [SOURCE] [ROCKFALL=yes]: /;s/^# //;/^set/!p}' "$pipelines/new_site.sh" ;;
    *) command=$1; shift; tool "$command" --help ;;
  esac
}

tool() {
  [ -x "$here/talus-$1" ] || refuse "$1 is not a command: expected run, new, help or a tool (talus help \
lists them)"
  command=$1
  shift
  exec "$here/talus-$command" "$@"
}

case ${1:-help} in
  run | new | help) command=${1:-help}; [ $# -eq 0 ] || shift; $command "$@" ;;
  -h | --help) help "" ;;
  --version) "$here/talus-dda" --version | sed s/-dda// ;;
  *) tool "$@" ;;
esac
