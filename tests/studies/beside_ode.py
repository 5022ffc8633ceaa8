#!/usr/bin/env python3
"""Speed on a slide of touching blocks beside ODE: 39 blocks over 20 s, 390 over 10 s, 3,900 over the first second.

Runs in turn, medians. Talus: step loop alone, with one and two threads; ODE: CPU time less set-up. kB a block are
those of the scene's state and scratch at the end. Needs bench_slide (release), ../shared/peers, c++ and libode-dev.
"""
import csv
import os
import re
import statistics
import subprocess

from study import SOURCE, Study, skip

CASES = {"39": ("Slide39/39/50/0/200", "terrain_F.asc", 20), "390": ("SlideDense/390/50/0/100", "terrain_G.asc", 10),
         "3900": ("SlideDense/3900/50/0/10", "terrain_G.asc", 1)}
TURNS = 3
STUDY = Study(__file__, __doc__)


def talus(study, blocks, threads, peers):
    said = study.run(study.bin.parent / "tests/bench/bench_slide", f"--benchmark_filter=^{CASES[blocks][0]}/",
                     "--benchmark_format=csv", env={**os.environ, "TALUS_BENCH_THREADS": str(threads), "TALUS_PEERS_DIR": str(peers)})
    row, = csv.DictReader(said[said.index("name,"):].splitlines())
    return float(row["cpu_time"]), float(row["real_time"]), float(row["kb_a_block"])


def ode(study, blocks, peers):
    _, terrain, duration_s = CASES[blocks]
    said = study.run(study.out / "peer_ode", "scene=F", "mode=def", f"terrain={terrain}", f"blocks=blocks_{blocks}.obj",
                     f"T={duration_s}", cwd=peers / "ode")
    return float(re.search(r"\bcpu=(\S+)", said.splitlines()[-1]).group(1))


@STUDY.part("all", 200)
def compute(study):
    peers = SOURCE.parent / "shared/peers"
    if not (peers / "ode/ode.cpp").exists() or not (study.bin.parent / "tests/bench/bench_slide").exists():
        skip("needs ../shared/peers and bench_slide (cmake --build --preset release --target bench_slide)")
    built = subprocess.run(["c++", "-O2", "-std=c++17", "-Wno-deprecated-declarations", "-I/usr/include/eigen3",
                            peers / "ode/ode.cpp", "-o", study.out / "peer_ode", "-lode"], capture_output=True, check=False)
    if built.returncode:
        skip("no ODE to build with (libode-dev, libeigen3-dev)")
    found = {blocks: [(talus(study, blocks, 1, peers), talus(study, blocks, 2, peers), ode(study, blocks, peers))
                      for _ in range(TURNS)] for blocks in CASES}
    for blocks, turns in found.items():
        one, two, peer = (statistics.median(pick(turn) for turn in turns) for pick in
                          (lambda t: t[0][0], lambda t: t[0][1] / t[1][1], lambda t: t[2]))
        study.row("blocks", blocks, {
            "simulated [s]": CASES[blocks][2], "CPU s": f"{one:.2f}", "ODE, CPU s": f"{peer:.2f}", "over ODE": f"{one / peer:.2f}",
            "times faster in two threads": f"{two:.2f}", "kB a block": f"{turns[0][0][2]:.0f}"})


if __name__ == "__main__":
    STUDY.main()
