#!/usr/bin/env python3
"""Validation against 18 runs of the rockfall tests at Tschamut (2014): run-out and angle of reach.

  python3 tests/studies/tschamut.py [BIN] [-o FOLDER] [--data FOLDER]

Each observed release is simulated with many blocks of its size and mass that start in random attitudes,
each alone, on the 5 m terrain that comes with the data. That terrain is interpolated from positions of
rolling blocks, so only distributions are compared. Two sets of parameters: from the literature, with
nothing fitted; and the best of a grid over friction angle and COR, which is also fitted to one half of
the runs and held against the other. Writes tschamut.csv (all settings), tschamut.svg (distributions)
and prints the table of docs/validation.md.
"""
import argparse
import csv
import math
import statistics
import subprocess
import sys
from pathlib import Path

LITERATURE = (30.0, 0.30)  # friction [degrees], COR; docs/validation.md says from where
FRICTIONS_DEG = (15, 17.5, 20, 22.5, 25, 30, 35, 40)
CORS = (0.05, 0.15, 0.3, 0.45)
DENSITY_KG_M3 = 2650
N_A_RELEASE = {"grid": 12, "final": 60}
QUANTITIES = {"run-out [m]": "chord_length_m", "angle of reach [deg]": "reach_angle_chord_deg"}


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def site_text(releases, sizes, n):
    """The site file: a section a release, `n` blocks each."""
    text = (f'[site]\nname = "tschamut"\n[material.gneiss]\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
            '[ground.meadow]\n[solver]\nduration_s = 60\nmax_lost_share = 1\n')
    for r in releases:
        size = sizes[r["block_id"]]
        text += (f'[blocks.{r["trajectory_id"]}]\nshape = "rock"\n'
                 f'size_m = [{size["size_x_m"]}, {size["size_y_m"]}, {size["size_z_m"]}]\n'
                 f'volume_m3 = {float(r["mass_kg"]) / DENSITY_KG_M3:.6f}\n'
                 f'position_m = [[{r["x_m"]}, {r["y_m"]}]]\nheight_above_ground_m = 0.1\n'
                 f'velocity_m_s = [{r["vx_mps"]}, {r["vy_mps"]}, {r["vz_mps"]}]\n'
                 f'random_orientation = true\nn_per_point = {n}\nseed = {int(r["trajectory_id"][1:])}\n')
    return text


class Slope:
    """Terrain and releases, simulated with any friction and COR."""

    def __init__(self, tools, data, folder):
        self.tools, self.folder, self.broken = tools, folder, []
        self.releases = rows_of(data / "release_points.csv")
        self.sizes = {r["block_id"]: r for r in rows_of(data / "block_metadata.csv")}
        self.run("talus-trn", data / "terrain.asc", "-o", "trn.tif", "--crs", "EPSG:2056")
        for name, n in N_A_RELEASE.items():
            (folder / f"{name}.toml").write_text(site_text(self.releases, self.sizes, n))
            self.run("talus-blocks", f"{name}.toml", "--trn", "trn.tif", "-o", f"{name}.h5")

    def run(self, tool, *words):
        done = subprocess.run([str(self.tools / tool), *map(str, words), "--no-db", "-q", "--overwrite"],
                              cwd=self.folder, capture_output=True, text=True)
        if done.returncode == 3:  # a limit of the run's health: told at the end, the run is used
            self.broken.append(done.stderr.strip())
        elif done.returncode != 0:
            sys.exit(done.stderr)

    def simulate(self, name, friction_deg, cor):
        """Rows of talus-runout, one a block, in the order of the releases."""
        self.run("talus-dda", f"{name}.toml", "--trn", "trn.tif", "--blocks", f"{name}.h5", "-o",
                 "run.h5", "--independent", "--frame-interval-s", 1, "--set", "output.passages=false",
                 "--set", f"ground.meadow.friction_deg={friction_deg}", "--set", f"ground.meadow.cor={cor}")
        self.run("talus-runout", "run.h5", "--trn", "trn.tif", "-o", "run.gpkg", "--csv", "run.csv",
                 "--allow-unfinished")
        return rows_of(self.folder / "run.csv")


def observed(data):
    """Run-out and angle of reach of each run, as the deposit's positions give them."""
    out = {name: [] for name in QUANTITIES}
    for row in rows_of(data / "observed_deposition.csv"):
        drop = float(row["release_z_m"]) - float(row["z_m"])
        length = float(row["observed_runout_m"])
        out["run-out [m]"].append(length)
        out["angle of reach [deg]"].append(math.degrees(math.atan2(drop, length)))
    return out


def quantity(rows, name, n, releases):
    """Values of `name` of the blocks of those releases, `n` blocks each."""
    return [float(rows[r * n + k][QUANTITIES[name]]) for r in releases for k in range(n)]


def distance(a, b):
    """Area between two distribution functions (first Wasserstein distance), unit of the values."""
    at = sorted([(x, 1 / len(a)) for x in a] + [(x, -1 / len(b)) for x in b])
    area = difference = 0.0
    for (x, step), (after, _) in zip(at, at[1:]):
        difference += step
        area += abs(difference) * (after - x)
    return area


def percentile(values, share):
    ordered = sorted(values)
    at = share * (len(ordered) - 1)
    low = int(at)
    return ordered[low] + (at - low) * (ordered[min(low + 1, len(ordered) - 1)] - ordered[low])


def best_setting(grid, seen, releases):
    """Setting whose run-outs of `releases` lie nearest to those seen."""
    n = N_A_RELEASE["grid"]
    wanted = [seen["run-out [m]"][r] for r in releases]
    return min(grid, key=lambda s: distance(quantity(grid[s], "run-out [m]", n, releases), wanted))


# --- what is shown ---------------------------------------------------------------------------------

def table(cases, seen):
    """Rows of Markdown: each set of parameters beside what was seen; lost: left the terrain."""
    print("| | friction [deg], COR | quantity | mean | p10 | p50 | p90 | area between the distributions "
          "| left the terrain |\n|---|---|---|---|---|---|---|---|---|")
    for name, setting, values, lost in cases:
        for q, list_of in values.items():
            figures = [statistics.mean(list_of)] + [percentile(list_of, p) for p in (0.1, 0.5, 0.9)]
            apart = "" if list_of is seen[q] else f"{distance(list_of, seen[q]):.1f}"
            print(f"| {name} | {setting} | {q} | " + " | ".join(f"{x:.1f}" for x in figures)
                  + f" | {apart} | {lost} |")


COLOURS = ("#222222", "#c1272d", "#0057a8")


def steps(values, x_of, y_of):
    """Points of an empirical distribution function, at most 200 steps."""
    n = min(len(values), 200)
    points, ordered = [], sorted(values)[:: len(values) // n]
    for k, x in enumerate(ordered):
        points += [(x_of(x), y_of(k / len(ordered))), (x_of(x), y_of((k + 1) / len(ordered)))]
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)


def panel(left, title, lists, ticks):
    """One distribution diagram, 300 x 240 from (left, 40)."""
    low, high = ticks[0], ticks[-1]
    x_of = lambda x: left + 300 * (min(max(x, low), high) - low) / (high - low)
    y_of = lambda share: 280 - 240 * share
    out = f'<rect x="{left}" y="40" width="300" height="240" fill="none" stroke="#888"/>'
    out += f'<text x="{left + 150}" y="318" text-anchor="middle">{title}</text>'
    for tick in ticks:
        out += (f'<path d="M{x_of(tick):.1f} 40V280" stroke="#ddd"/>'
                f'<text x="{x_of(tick):.1f}" y="298" text-anchor="middle">{tick}</text>')
    for share in (0, 0.5, 1):
        out += f'<text x="{left - 6}" y="{y_of(share) + 4:.1f}" text-anchor="end">{share}</text>'
    out += (f'<text x="{left - 34}" y="160" transform="rotate(-90 {left - 34} 160)" '
            'text-anchor="middle">share below</text>')
    for values, colour in zip(lists, COLOURS):
        out += f'<polyline points="{steps(values, x_of, y_of)}" fill="none" stroke="{colour}" stroke-width="1.8"/>'
    return out


def picture(cases):
    out = ('<svg xmlns="http://www.w3.org/2000/svg" width="760" height="330" font-family="sans-serif" '
           'font-size="12"><rect width="760" height="330" fill="white"/>')
    for k, (name, setting, _, _) in enumerate(cases):
        words = f"{name} ({setting})" if setting else name
        out += (f'<path d="M{50 + 240 * k} 18h20" stroke="{COLOURS[k]}" stroke-width="2"/>'
                f'<text x="{75 + 240 * k}" y="22">{words}</text>')
    for k, (q, ticks) in enumerate(zip(QUANTITIES, ([0, 50, 100, 150, 200], [15, 20, 25, 30, 35, 40]))):
        out += panel(60 + 365 * k, q, [values[q] for _, _, values, _ in cases], ticks)
    return out + "</svg>\n"


def main():
    here = Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("bin", nargs="?", default=here / "build/release/tools", type=Path)
    parser.add_argument("-o", "--out", default=here / "build/tschamut", type=Path)
    parser.add_argument("--data", default=here / "../shared/data/experiments/tschamut2014", type=Path)
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    seen = observed(args.data)
    slope = Slope(args.bin.resolve(), args.data.resolve(), args.out)
    every = range(len(slope.releases))

    grid = {(f, c): slope.simulate("grid", f, c) for f in FRICTIONS_DEG for c in CORS}
    with open(args.out / "tschamut.csv", "w", encoding="utf-8") as file:
        file.write("friction_deg,cor,mean_runout_m,distance_runout_m,distance_angle_deg\n")
        for (f, c), rows in grid.items():
            values = {q: quantity(rows, q, N_A_RELEASE["grid"], every) for q in QUANTITIES}
            file.write(f"{f},{c},{statistics.mean(values['run-out [m]']):.2f},"
                       + ",".join(f"{distance(values[q], seen[q]):.2f}" for q in QUANTITIES) + "\n")

    calibrated = best_setting(grid, seen, every)
    cases = [("observed, 18 runs", "", seen, "")]
    for name, (f, c) in (("literature", LITERATURE), ("calibrated", calibrated)):
        rows = slope.simulate("final", f, c)
        lost = sum(row["fate"] == "left_domain" for row in rows) / len(rows)
        values = {q: quantity(rows, q, N_A_RELEASE["final"], every) for q in QUANTITIES}
        cases.append((name, f"{f:g}, {c:g}", values, f"{100 * lost:.0f} %"))
    table(cases, seen)
    for begin in (0, 1):  # fitted to every second run, held against the others
        fitted, held = list(every)[begin::2], list(every)[1 - begin::2]
        setting = best_setting(grid, seen, fitted)
        apart = [distance(quantity(grid[s], "run-out [m]", N_A_RELEASE["grid"], held),
                          [seen["run-out [m]"][r] for r in held]) for s in (setting, LITERATURE)]
        print(f"fitted to {len(fitted)} runs: {setting}; the other {len(held)}: {apart[0]:.1f} m apart, "
              f"with the literature's {apart[1]:.1f} m")
    for words in slope.broken:
        print(words)
    (args.out / "tschamut.svg").write_text(picture(cases), encoding="utf-8")


if __name__ == "__main__":
    main()
