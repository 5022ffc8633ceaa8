#!/bin/sh
# Speed on the peers' slide: 39 blocks over 20 s, 390 over 10 s, 3,900 over the first second, with one
# and with two threads, beside ODE where its sources and its library are there. Runs in turn, medians;
# Talus: step loop alone, CPU and wall time [s]; ODE: CPU time less set-up. Bytes a block are
# those of the scene's state and scratch at the end.
# sh tests/bench/against_ode.sh PEERS_ODE_FOLDER OUT [RUNS], after building bench_slide (release)
set -eu
folder=$(cd "$1" && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
runs=${3:-3}
source_dir=$(cd "$(dirname "$0")/../.." && pwd)
bench=${BENCH_SLIDE:-$source_dir/build/release/tests/bench/bench_slide}
[ -x "$bench" ] || { echo "no $bench: cmake --build build/release --target bench_slide" >&2; exit 1; }
TALUS_PEERS_DIR=$(cd "$folder/.." && pwd)
export TALUS_PEERS_DIR

ode=$out/peer_ode
if [ -f "$folder/ode.cpp" ]; then
  c++ -O2 -std=c++17 -Wno-deprecated-declarations -I/usr/include/eigen3 "$folder/ode.cpp" -o "$ode" \
    -lode 2>"$out/peer_ode.log" || echo "ODE is left out: see $out/peer_ode.log (libode-dev, libeigen3-dev)"
fi

# talus THREADS BLOCKS FILTER: a line "BLOCKS talusTHREADS USER WALL KB_A_BLOCK"
talus() {
  TALUS_BENCH_THREADS=$1 "$bench" --benchmark_filter="^$3/" --benchmark_format=csv 2>/dev/null |
    awk -F, -v n="$2" -v who="talus$1" '
      /^name/ { for (i = 1; i <= NF; i++) { gsub(/"/, "", $i); at[$i] = i } }
      /^"Slide/ { print n, who, $(at["cpu_time"]), $(at["real_time"]), $(at["kb_a_block"]) }'
}
# peer BLOCKS TERRAIN SECONDS: a line "BLOCKS ode CPU CPU 0"
peer() {
  [ -x "$ode" ] || return 0
  (cd "$folder" && "$ode" scene=F mode=def terrain="$2" blocks="blocks_$1.obj" T="$3") |
    tail -1 | awk -v n="$1" '{
      for (i = 1; i <= NF; i++) if (split($i, part, "=") == 2 && part[1] == "cpu") cpu = part[2]
      print n, "ode", cpu, cpu, 0 }'
}

: >"$out/runs.txt"
i=0
while [ "$i" -lt "$runs" ]; do
  i=$((i + 1))
  for threads in 1 2; do talus $threads 39 Slide39/39/50/0/200; done
  peer 39 terrain_F.asc 20
  for threads in 1 2; do talus $threads 390 SlideDense/390/50/0/100; done
  talus 1 390_first SlideDense/390/50/0/10
  peer 390 terrain_G.asc 10
  for threads in 1 2; do talus $threads 3900 SlideDense/3900/50/0/10; done
  peer 3900 terrain_G.asc 1
done >>"$out/runs.txt"

# medians, then the table
for column in 3 4 5; do
  sort -k1,1n -k2,2 -k$column,${column}n "$out/runs.txt" | awk -v c=$column '
    { key = $1 " " $2; if (key != last) { flush(); last = key; n = 0 } value[++n] = $c }
    function flush() { if (n) print last, value[int((n + 1) / 2)] }
    END { flush() }' >"$out/median_$column"
done
awk -v runs="$runs" '
  FILENAME ~ /3$/ { user[$1, $2] = $3; next }
  FILENAME ~ /4$/ { wall[$1, $2] = $3; next }
  { kb[$1, $2] = $3 }
  function per(a, b) { return b > 0 ? sprintf("%.2f", a / b) : "-" }
  END {
    split("39 390 3900", blocks, " "); split("20 10 1", length_s, " ")
    print "| blocks | simulated s | CPU s | ODE CPU s | Talus / ODE | wall s, 1 thread | 2 threads | times faster | kB a block |"
    print "|---|---|---|---|---|---|---|---|---|"
    for (i = 1; i <= 3; i++) {
      n = blocks[i]
      printf "| %s | %s | %.2f | %s | %s | %.2f | %.2f | %s | %.1f |\n", n, length_s[i], user[n, "talus1"],
        (n, "ode") in user ? sprintf("%.2f", user[n, "ode"]) : "-", per(user[n, "talus1"], user[n, "ode"]),
        wall[n, "talus1"], wall[n, "talus2"], per(wall[n, "talus1"], wall[n, "talus2"]), kb[n, "talus1"]
    }
    rate = user[3900, "talus1"] / user["390_first", "talus1"]
    printf "The first second takes time by the number of blocks to the power %.2f (390 to 3,900). Medians of %d runs.\n",
      log(rate) / log(10), runs
  }' "$out/median_3" "$out/median_4" "$out/median_5" | tee "$out/table.md"
