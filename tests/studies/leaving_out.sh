#!/bin/sh
# What leaving out saves: six scenes with the scene's own plan, with --plan=full, and with all but
# strains; CPU seconds (median of three runs) and how far the mean displacements lie from the plan's.
# Then single items, kept and left out, where a scene shows them.
#   sh tests/studies/leaving_out.sh [BIN]      BIN: folder of the executables
set -eu
cd "$(dirname "$0")/../.."
bin=$(cd "${1:-build/release/tools}" && pwd)
PATH=$bin:$PATH
site=$(pwd)/sample_sites/designed
common=$(pwd)/tests/tools/talus-dda/common.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
. "$common"
make_terrain

# scene NAME DURATION_S MATERIAL GROUND REST: a site file on the slope
scene() {
  printf '[site]\nname = "%s"\n[material.rock]\n%b\n[ground.ground]\n%b\n[solver]\nduration_s = %s\nmax_lost_share = 1\n%b\n' \
    "$1" "$3" "$4" "$2" "$5" >"$1.toml"
  talus-blocks "$1.toml" --trn slope.tif -o "$1.h5" -q --no-db
  cp slope.tif "$1.tif"
}

# box NAME X SIZE HEIGHT: a block of the site file
box() { printf '[blocks.%s]\nshape = "box"\nsize_m = [%s, %s, %s]\nposition_m = [[%s, 5000050]]\nheight_above_ground_m = %s\n' "$1" "$3" "$3" "$3" "$2" "$4"; }

scene lone 20 'density_kg_m3 = 2600' 'friction_deg = 25\ncor = 0.6' "$(box a 500020 1 3)"
scene stack 5 'density_kg_m3 = 2600\nfriction_deg = 35' 'friction_deg = 35\ncor = 0' \
  "$(box a 500125 1 0.001 && box b 500125 1 1.002 && box c 500125 1 2.003)"
scene soft 4 'density_kg_m3 = 2600\nyoung_modulus_pa = 1e7' 'friction_deg = 20\ncor = 0.3' "$(box a 500030 4 0.2)"
scene cohesive 4 'density_kg_m3 = 2600' 'friction_deg = 20\ncohesion_pa = 1e5\ncor = 0' "$(box a 500030 2 0)"
scene fence 8 'density_kg_m3 = 2600' 'friction_deg = 20\ncor = 0.4' \
  "$(box a 500020 2 0.5)\n[fence.low]\nline = [[500060, 5000010], [500060, 5000090]]\nheight_m = 4\n"

scene apart 6 'density_kg_m3 = 2600' 'friction_deg = 25\ncor = 0.6' \
  "$(box a 500020 1 3 && box b 500050 1 3 && box c 500080 1 3)"

sed 's/^duration_s.*/duration_s = 4/' "$site/site.toml" >slide.toml
talus-tin "$site/contours.gpkg" -o slide.ply --elevation-field elevation_m -q --no-db
talus-trn slide.ply -o full.tif --cell-size-m 8 --window 500000,5200000,500224,5200320 -q --no-db
cp "$site/contours.gpkg" .
talus-blocks slide.toml --trn full.tif -o slide.h5 --trn-out slide.tif -q --no-db

# run NAME PLAN: JSON reports of three runs, NAME.PLAN.1 to .3
run() {
  for i in 1 2 3; do
    code=0  # a broken limit of the run's health does not matter here
    talus-dda "$1.toml" --trn "$1.tif" --blocks "$1.h5" -o run.h5 --overwrite --settle --no-db \
      --json $3 >"$1.$2.$i" 2>log || code=$?
    [ "$code" -eq 0 ] || [ "$code" -eq 3 ] || { cat log >&2; exit 1; }
  done
}
for name in lone slide stack soft cohesive fence; do
  run $name plan ""
  run $name full --plan=full
  run $name rigid "--plan=full --set solver.strain=off"
done
run lone bare "--set output.passages=false"
run lone shaken "--set base_motion.amplitude_m_s2=1e-300 --set base_motion.frequency_hz=1"
run apart plan ""
run apart alone --independent
python3 - <<'END'
import json, statistics
print("| Scene | CPU s | full | ratio | all but strains | ratio | m apart, full | m apart, all but strains "
      "| m moved | strains |\n|---|---|---|---|---|---|---|---|---|---|")
plans = ("plan", "full", "rigid")
for name in ["lone", "slide", "stack", "soft", "cohesive", "fence"]:
    reports = {p: [json.load(open(f"{name}.{p}.{i}")) for i in (1, 2, 3)] for p in plans}
    cpu = {p: statistics.median(r["cpu_time_s"] for r in reports[p]) for p in plans}
    moved = {p: reports[p][0]["mean_displacement_m"] for p in plans}
    apart = {p: sum((x - y) ** 2 for x, y in zip(moved["plan"], moved[p])) ** 0.5 for p in plans}
    kept = next(i["on"] for i in reports["plan"][0]["plan"] if i["item"] == "strains")
    length = sum(x * x for x in moved["plan"]) ** 0.5
    print(f"| {name} | {cpu['plan']:.3f} | {cpu['full']:.3f} | {cpu['full'] / cpu['plan']:.2f} | {cpu['rigid']:.3f} | "
          f"{cpu['rigid'] / cpu['plan']:.2f} | {apart['full']:.1e} | {apart['rigid']:.1e} | {length:.2f} | "
          f"{'kept' if kept else 'left out'} |")
print("\n| Item | Scene | CPU s, kept | left out | ratio | m apart |\n|---|---|---|---|---|---|")
for item, scene, kept, left in (("passages", "lone", "plan", "bare"), ("contacts of blocks", "apart", "plan", "alone"),
                                ("base motion", "lone", "shaken", "plan")):
    reports = [[json.load(open(f"{scene}.{p}.{i}")) for i in (1, 2, 3)] for p in (kept, left)]
    cpu = [statistics.median(r["cpu_time_s"] for r in list) for list in reports]
    moved = [list[0]["mean_displacement_m"] for list in reports]
    apart = sum((x - y) ** 2 for x, y in zip(*moved)) ** 0.5
    print(f"| {item} | {scene} | {cpu[0]:.3f} | {cpu[1]:.3f} | {cpu[0] / cpu[1]:.2f} | {apart:.1e} |")
END
