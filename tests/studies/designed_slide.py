#!/usr/bin/env python3
"""The designed slide without its fence, both laws, several time steps, seeds that differ by 1e-4 m/s.

Means over the seeds, with the range; the CPU time of talus-dda is the median.
"""
import json
import statistics

from real_sites import runs_of
from study import SOURCE, Study

SETTINGS = [  # law, time step [s], seeds, CPU seconds a run
    ("talus", 1e-3, 10, 5), ("talus", 5e-3, 10, 2), ("talus", 1e-2, 10, 1), ("talus", 2e-2, 10, 1), ("talus", 5e-2, 10, 1),
    ("paper", 1e-4, 3, 22), ("paper", 2e-4, 3, 13), ("paper", 1e-3, 3, 5)]

STUDY = Study(__file__, __doc__)


def spread(values, digits):
    return tuple(f"{value:.{digits}f}" for value in (statistics.mean(values), min(values), max(values)))


def compute(study, law, step_s, n_seeds):
    out = study.out / f"{law}_{step_s:g}"
    words = [f"OUT={out}", f"RUNS={n_seeds}", "WITHOUT=no",
             f"DDA_FLAGS=--set solver.law={law} --set solver.time_step_s={step_s} --set fence.valley.active=false"]
    # a run that breaks a limit of its health keeps its file, and make takes it as made the second time
    study.make(SOURCE / "sample_sites/designed", *words, "runs", keep_going=True)
    study.make(SOURCE / "sample_sites/designed", *words, "runout")
    _, n_broken, cpu = runs_of(study, out)
    result = json.loads((out / "runout.json").read_text())
    of = lambda part, key: [run[part][key] for run in result["runs"]]
    study.row("free", f"{law}, {step_s:g} s", {
        "seeds": n_seeds, "centre, L [m]": spread(of("centre_of_mass", "L_path_m"), 1),
        "centre, H/L": f"{statistics.mean(of('centre_of_mass', 'H_over_L')):.3f}",
        "angle of reach [degrees]": spread(of("event", "reach_angle_path_deg"), 2),
        "toe, L [m]": spread(of("event", "L_path_m"), 1), "broke a limit": n_broken,
        "CPU s a run": f"{statistics.median(cpu):.2f}"})


for law, step_s, n_seeds, cost_s in SETTINGS:
    STUDY.part(f"{law}_{step_s:g}", cost_s * n_seeds)(lambda study, case=(law, step_s, n_seeds): compute(study, *case))

if __name__ == "__main__":
    STUDY.main()
