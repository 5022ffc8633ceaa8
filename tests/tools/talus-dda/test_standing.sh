# The run of a stable mass ends after 3 s, and the run says so; one that moves, or may move later,
# does not.
. "$source_dir/tests/tools/talus-dda/common.sh"
make_terrain
make_site
sed -i -e 's/^height_above_ground_m.*/height_above_ground_m = 0.001\npitch_deg = 30/' -e '/^spin_rad_s/d' site.toml
make_blocks
ground=$(grep -o 'ground\.[a-z]*' site.toml | head -1)
# run NAME FRICTION OPTIONS...
run() {
  name=$1 friction=$2
  shift 2
  expect 0 talus-dda site.toml --trn slope.tif --blocks blocks.h5 -o "$name.h5" --no-db --json --set solver.duration_s=5 \
    --set "$ground.friction_deg=$friction" "$@"
  mv out "$name.json"
}
time_of() { sed -n 's/^  "time_s": \([0-9.e+-]*\),*$/\1/p' "$1.json"; }
run held 80
says "the mass stands: no block moved more than 0.1 m in 3 s; the other 2 s were left out"
case $(time_of held) in 3* | 2.99*) ;; *) fail "ended at $(time_of held) s" ;; esac
grep -q '"status": "done"' held.json || fail "a run that stands is not done"
run whole 80 --set solver.end_when_standing=false
case $(time_of whole) in 5* | 4.99*) ;; *) fail "ended at $(time_of whole) s" ;; esac
run sliding 10
case $(time_of sliding) in 5* | 4.99*) ;; *) fail "ended at $(time_of sliding) s" ;; esac
if grep -q "the mass stands" err; then fail "a mass that slides is said to stand"; fi
# an earthquake to come
run shaken 80 --set base_motion.amplitude_m_s2=0.1 --set base_motion.frequency_hz=1 --set base_motion.start_s=4 \
  --set base_motion.duration_s=1
case $(time_of shaken) in 5* | 4.99*) ;; *) fail "ended at $(time_of shaken) s" ;; esac

# evaluated like any other run
expect 0 talus-runout held.h5 --trn slope.tif -o held.gpkg --no-db
prints "1 of 1 run did not move"
