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
# stands_for_runs CASE N OPTIONS...: files of N runs, and the note that they have the settings of now
stands_for_runs() {
  case=$1 n=$2
  shift 2
  key=$(make -C slope BIN="$PWD/tools/" WITHOUT=no RUNS=1 "$@" -pnq runs 2>/dev/null | sed -n "s/^key_$case := //p")
  [ -n "$key" ] || fail "make has no key for the runs"
  mkdir -p slope/out/stages/made
  seq -f "out/runs/run_${case:+${case}_}%.0f.h5" "$n" | while read -r name; do
    echo run >"slope/$name"
    echo "$key run $name"
  done >>slope/out/stages/made/runs
}
stands_for_runs '' 10000
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
for case in V1 V2; do stands_for_runs $case 5000 CASES='V1 V2'; done
eval "expect 0 make -C slope BIN=\"\$PWD/tools/\" $many hazard trace"
for file in hazard.json trace.gpkg; do
  [ "$(cat slope/out/$file)" = " V1 5000 V2 5000" ] || fail "$file was made from $(cat slope/out/$file)"
done
