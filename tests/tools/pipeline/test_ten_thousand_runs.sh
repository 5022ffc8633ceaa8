# Ten thousand runs are more names than a line of the shell holds: what evaluates them gets them all, and
# make submit parts them. Stand-ins for the runs and for the tool.
. "$source_dir/tests/tools/pipeline/common.sh"
mkdir tools
for tool in "${bin%%:*}"/talus-*; do [ ! -f "$tool" ] || ln -s "$tool" tools; done
rm tools/talus-maps
cat >tools/talus-maps <<'END'
#!/bin/sh
n=0
for word; do
  case $word in
    out/runs/run_*.h5) n=$((n + 1)) ;;
    *.list.there) n=$((n + $(grep -c '^out/runs/run_.*h5$' "$word"))) ;;
  esac
done
mkdir -p out/maps
echo "$n runs" >out/maps/reach.tif
END
chmod +x tools/talus-maps
site slope
many='RUNS=10000 WITHOUT=no'
# shellcheck disable=SC2086  # words of make
made slope $many prepare
prints "10000 runs to make"
# shellcheck disable=SC2086
made slope -n $many SHARDS=300 submit
prints "--array=1-300 "
(cd slope/out/runs && seq -f 'run_%.0f.h5' 10000 | while read -r name; do echo run >"$name"; done)
# shellcheck disable=SC2086
expect 0 make -C slope BIN="$PWD/tools/" $many maps
[ "$(cat slope/out/maps/reach.tif)" = "10000 runs" ] || fail "talus-maps was given $(cat slope/out/maps/reach.tif)"
