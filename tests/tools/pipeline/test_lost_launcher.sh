# The starter of a tool may lose it and yet end well, as srun does when its node dies: make says
# which file lacks and ends there; a run that was lost is listed, and made by the next make.
. "$source_dir/tests/tools/pipeline/common.sh"
mkdir tools
for tool in "${bin%%:*}"/talus-*; do
  [ -f "$tool" ] || continue
  cat >"tools/${tool##*/}" <<END
#!/bin/sh
# the loss of a node: a starter that ends well and has done nothing
case " \$* " in *"\${LOSE:-nothing}"*) exit 0 ;; esac
exec $tool "\$@"
END
  chmod +x "tools/${tool##*/}"
done
lost() { LOSE="$1" expect 2 make -C slope BIN="$PWD/tools/" WITHOUT=no RUNS=3 runout; }
site slope
for output in out/trn.tif out/blocks.h5 out/runout.gpkg; do
  lost "-o $output"
  says "ended without an error and yet did not write $output: what starts it (BIN) lost it"
done
made slope WITHOUT=no RUNS=3 runout

# with an output of an earlier site file in its place
sed -i 's/^friction_deg = 25/friction_deg = 26/' slope/site.toml
sed -i 's/^spacing_m = 7.8/spacing_m = 7.9/' slope/site.toml
lost "-o out/blocks.h5"
says "did not write out/blocks.h5"
lost "-o out/runs/run_2.h5"
says "1 of 3 runs failed:"
says "run_2: did not end by itself"
says "runs: 2 done, 1 failed, 0 to go"
made slope WITHOUT=no RUNS=3 runout
if grep -q 'N_MISSING' slope/out/runout.json; then fail "a run is missing"; fi
