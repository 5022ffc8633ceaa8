#!/usr/bin/env python3
"""The designed slide without its fence, both laws, and with it, law talus; several time steps, seeds that differ by 1e-4 m/s.

  python3 tests/studies/designed_slide.py [BIN [OUT]]

BIN: folder of the executables (default: build/release/tools); OUT: kept results (default: a temporary
folder). Prints the tables of docs/evidence/measurements.md: mean over the seeds, in brackets the range, and the CPU
time of talus-dda, median over the seeds (from the registry); after the first one the mean speed of the mass over
time, of one run at the default step.
"""
import csv
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
HEAD = ("| law | dt [s] | seeds | L_cm [m] | H_cm / L_cm | angle of reach, path [deg] | chord [deg] | L of the toe [m] | health | CPU s a run |\n"
        "|---|---|---|---|---|---|---|---|---|---|")
FREE = [  # law, time step [s], seeds
    ("talus", 1e-3, 20), ("talus", 5e-3, 20), ("talus", 1e-2, 20), ("talus", 2e-2, 20), ("talus", 5e-2, 20),
    ("paper", 1e-4, 3), ("paper", 2e-4, 3), ("paper", 1e-3, 3)]
FENCED = [("talus", 1e-3, 20), ("talus", 2e-3, 20), ("talus", 5e-3, 20), ("talus", 1e-2, 20), ("talus", 2e-2, 20)]


def simulate(tools, out, law, step_s, n_seeds, fence):
    """talus-runout's answer for the runs of one setting, and their CPU seconds."""
    make = ["make", "-k", "-s", "-C", SOURCE / "sample_sites/designed", f"BIN={tools}/", f"OUT={out}", f"RUNS={n_seeds}",
            "WITHOUT=no", f"DDA_FLAGS=--set solver.law={law} --set solver.time_step_s={step_s} --set fence.valley.active={fence}"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    # a run that breaks a limit of its health keeps its file, and make takes it as made the second time
    subprocess.run([*make, "runs"], check=False, **quiet)
    subprocess.run([*make, "runout"], check=True, **quiet)
    runs = json.loads(subprocess.run([tools / "talus-runs", "--db", out / "runs.sqlite", "list", "--json"], check=True,
                                     capture_output=True, text=True).stdout)["runs"]
    cpu = [run["cpu_time_s"] for run in runs if run["tool"] == "talus-dda"]
    return json.loads((out / "runout.json").read_text()), cpu


def spread(values, digits):
    mean = statistics.mean(values)
    return f"{mean:.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def print_table(tools, out, settings, fence):
    print(HEAD)
    for law, step_s, n_seeds in settings:
        result, cpu = simulate(tools, out / f"{law}_{step_s:g}", law, step_s, n_seeds, fence)
        runs = result["runs"]
        of = lambda *keys: [run[keys[0]][keys[1]] for run in runs]
        print(f"| {law} | {step_s:g} | {n_seeds} | {spread(of('centre_of_mass', 'L_path_m'), 1)} | "
              f"{statistics.mean(of('centre_of_mass', 'H_over_L')):.3f} | {spread(of('event', 'reach_angle_path_deg'), 2)} | "
              f"{spread(of('event', 'reach_angle_chord_deg'), 2)} | {spread(of('event', 'L_path_m'), 1)} | "
              f"{result['tags']['HEALTH']} | {statistics.median(cpu):.2f} |", flush=True)


def main():
    tools = Path(sys.argv[1] if len(sys.argv) > 1 else SOURCE / "build/release/tools").resolve()
    out = Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp()).resolve()
    print_table(tools, out, FREE, "false")
    with open(out / "talus_0.005/curves.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    first = [row for row in rows if row["run_id"] == rows[0]["run_id"]]
    print("\nmean speed [m/s]: " + ", ".join(f"{float(row['mean_speed_m_s']):.1f} at {float(row['time_s']):.0f} s"
                                            for row in first if abs(float(row["time_s"]) % 2) < 1e-6))
    print("\nwith the fence:")
    print_table(tools, out / "fence", FENCED, "true")


main()
