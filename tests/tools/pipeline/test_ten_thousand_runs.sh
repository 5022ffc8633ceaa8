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
    *.list.in_parts) n=$((n + $(grep -c '^out/runs/run_.*h5$' "$word"))) ;;
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

# by class: 5,000 runs of each case, in a list a class
for tool in hazard trace; do
  rm "tools/talus-$tool"
  cat >"tools/talus-$tool" <<'END'
#!/bin/sh
counts=
for word; do
  case $word in V?=@*) counts="$counts ${word%%=*} $(grep -c "^out/runs/run_${word%%=*}_.*h5$" "${word#*@}")" ;; esac
done
mkdir -p out/hazard
for file in hazard.json trace.gpkg trace.json links.csv; do echo "$counts" >out/$file; done
END
  chmod +x "tools/talus-$tool"
done
printf '[hazard.class.V%s]\nfrequency_per_a = 0.01\n' 1 2 >>slope/site.toml
many="RUNS=5000 WITHOUT=no CASES=V1\\ V2"
eval "made slope $many prepare"
(cd slope/out/runs && for case in V1 V2; do seq -f "run_${case}_%.0f.h5" 5000; done | while read -r name; do echo run >"$name"; done)
eval "expect 0 make -C slope BIN=\"\$PWD/tools/\" $many hazard trace"
for file in hazard.json trace.gpkg; do
  [ "$(cat slope/out/$file)" = " V1 5000 V2 5000" ] || fail "$file was made from $(cat slope/out/$file)"
done
