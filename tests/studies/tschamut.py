#!/usr/bin/env python3
"""Validation against 18 runs of the rockfall tests at Tschamut (2014): run-out and angle of reach.

  python3 tests/studies/tschamut.py [BIN] [-o FOLDER] [--data FOLDER] [--quick]

Each observed release is simulated with many blocks of its size and mass that start in random attitudes,
each alone, on the 5 m terrain that comes with the data. That terrain is interpolated from positions of
rolling blocks, so only distributions are compared. Blocks start where they were measured, up to 1.4 m
above that terrain, with the measured velocity; --settle lifts those that it would bury.

Compared are:

- `soil = "meadow"` as it is, with nothing fitted, and firm ground with values of the literature;
- the same meadow with hulls of 8, 12 and 40 points, and with other friction and time steps;
- rolling resistance and half speed from a grid, fitted to one half of the runs and held against the other.

Intervals are of the 18 runs drawn again (bootstrap). Writes tschamut.csv (the grid), tschamut.svg
(distributions) and prints the tables of docs/validation.md. --quick: the meadow alone.
"""
import argparse
import csv
import math
import random
import statistics
import subprocess
import sys
from pathlib import Path

FIRM = {"friction_deg": 30, "cor": 0.3}  # docs/validation.md says from where
MEADOW = {"soil": "meadow"}
ROLLING = (0.05, 0.08, 0.11, 0.14, 0.17, 0.20, 0.25, 0.30)
HALF_SPEEDS = (5, 10, 20)
POINTS = (8, 12, 20, 40)  # of the hulls
DENSITY_KG_M3 = 2650
N_A_RELEASE = {"grid": 12, "final": 60}
QUANTITIES = {"run-out [m]": "chord_length_m", "angle of reach [deg]": "reach_angle_chord_deg"}


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def site_text(releases, sizes, n, points):
    """The site file: a section a release, `n` blocks each, hulls of `points` points."""
    text = (f'[site]\nname = "tschamut"\n[material.gneiss]\ndensity_kg_m3 = {DENSITY_KG_M3}\n'
            '[ground.meadow]\n[solver]\nduration_s = 60\nmax_lost_share = 1\n')
    for r in releases:
        size = sizes[r["block_id"]]
        text += (f'[blocks.{r["trajectory_id"]}]\nshape = "rock"\nn_points = {points}\n'
                 f'size_m = [{size["size_x_m"]}, {size["size_y_m"]}, {size["size_z_m"]}]\n'
                 f'volume_m3 = {float(r["mass_kg"]) / DENSITY_KG_M3:.6f}\n'
                 f'position_m = [[{r["x_m"]}, {r["y_m"]}, {r["z_m"]}]]\n'
                 f'velocity_m_s = [{r["vx_mps"]}, {r["vy_mps"]}, {r["vz_mps"]}]\n'
                 f'random_orientation = true\nn_per_point = {n}\nseed = {int(r["trajectory_id"][1:])}\n')
    return text


class Slope:
    """Terrain and releases, simulated on any ground."""

    def __init__(self, tools, data, folder):
        self.tools, self.folder, self.broken = tools, folder, []
        self.releases = rows_of(data / "release_points.csv")
        self.sizes = {r["block_id"]: r for r in rows_of(data / "block_metadata.csv")}
        self.run("talus-trn", data / "terrain.asc", "-o", "trn.tif", "--crs", "none")

    def blocks(self, n, points):
        """Name of the site file and the blocks of `n` hulls a release."""
        name = f"rocks_{n}_{points}"
        if not (self.folder / f"{name}.h5").exists():
            (self.folder / f"{name}.toml").write_text(site_text(self.releases, self.sizes, n, points))
            self.run("talus-blocks", f"{name}.toml", "--trn", "trn.tif", "-o", f"{name}.h5")
        return name

    def run(self, tool, *words):
        done = subprocess.run([str(self.tools / tool), *map(str, words), "--no-db", "-q", "--overwrite"],
                              cwd=self.folder, capture_output=True, text=True)
        if done.returncode == 3:  # a limit of the run's health: told at the end, the run is used
            self.broken.append(done.stderr.strip())
        elif done.returncode != 0:
            sys.exit(done.stderr)

    def simulate(self, ground, n="grid", points=20, *more):
        """Rows of talus-runout, one a block, in the order of the releases."""
        name = self.blocks(N_A_RELEASE[n], points)
        words = [w for key, value in ground.items() for w in ("--set", f"ground.meadow.{key}={value}")]
        self.run("talus-dda", f"{name}.toml", "--trn", "trn.tif", "--blocks", f"{name}.h5", "-o",
                 "run.h5", "--independent", "--settle", "--frame-interval-s", 1, "--set", "output.passages=false",
                 *words, *more)
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


def interval(rows, n, seen, ticks=400):
    """95 % of the area between the distributions of run-out, of the runs drawn again."""
    draw, areas = random.Random(1), []
    per_release = [quantity(rows, "run-out [m]", n, [r]) for r in range(len(seen["run-out [m]"]))]
    for _ in range(ticks):
        runs = [draw.randrange(len(per_release)) for _ in per_release]
        areas.append(distance([x for r in runs for x in per_release[r]],
                              [seen["run-out [m]"][r] for r in runs]))
    return percentile(areas, 0.025), percentile(areas, 0.975)


# --- what is shown ---------------------------------------------------------------------------------

def lost_share(rows):
    return sum(row["fate"] == "left_domain" for row in rows) / len(rows)


def figures(values):
    return [statistics.mean(values)] + [percentile(values, p) for p in (0.1, 0.5, 0.9)]


def table(cases, seen):
    """Rows of Markdown: each set of parameters beside what was seen; lost: left the terrain."""
    print("| | ground | quantity | mean | p10 | p50 | p90 | area between the distributions (95 %) "
          "| left the terrain |\n|---|---|---|---|---|---|---|---|---|")
    for name, setting, values, lost, (low, high) in cases:
        for q, list_of in values.items():
            apart = "" if list_of is seen[q] else f"{distance(list_of, seen[q]):.1f}"
            if apart and q == "run-out [m]":
                apart += f" ({low:.1f} to {high:.1f})"
            print(f"| {name} | {setting} | {q} | " + " | ".join(f"{x:.1f}" for x in figures(list_of))
                  + f" | {apart} | {lost} |")


def variants(slope, seen):
    """How far the meadow runs out with other shapes, friction and steps: rows of Markdown."""
    n = N_A_RELEASE["grid"]
    every = range(len(slope.releases))
    print("\n| hull, ground, step | mean | p10 | p50 | p90 | area | left the terrain |\n|---|---|---|---|---|---|---|")
    kinds = [(f"{p} points", MEADOW, p, ()) for p in POINTS]
    kinds += [(f"{p} points, no rolling resistance", MEADOW | {"rolling_resistance": 0}, p, ()) for p in POINTS]
    kinds += [(f"friction {f} degrees", MEADOW | {"friction_deg": f}, 20, ()) for f in (31, 39, 45)]
    kinds += [(f"step {h} s", MEADOW, 20, ("--set", f"solver.time_step_s={h}"))
              for h in (0.0025, 0.00125)]
    kinds += [(f"bearing {q} kPa", MEADOW | {"bearing_kpa": q}, 20, ()) for q in (50, 82, 200)]
    for words, ground, points, more in kinds:
        rows = slope.simulate(ground, "grid", points, *more)
        values = quantity(rows, "run-out [m]", n, every)
        print(f"| {words} | " + " | ".join(f"{x:.0f}" for x in figures(values))
              + f" | {distance(values, seen['run-out [m]']):.1f} | {100 * lost_share(rows):.0f} % |")


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
    for k, (name, setting, *_) in enumerate(cases):
        words = f"{name} ({setting})" if setting else name
        out += (f'<path d="M{50 + 240 * k} 18h20" stroke="{COLOURS[k]}" stroke-width="2"/>'
                f'<text x="{75 + 240 * k}" y="22">{words}</text>')
    for k, (q, ticks) in enumerate(zip(QUANTITIES, ([0, 50, 100, 150, 200], [15, 20, 25, 30, 35, 40]))):
        out += panel(60 + 365 * k, q, [case[2][q] for case in cases], ticks)
    return out + "</svg>\n"


def main():
    here = Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("bin", nargs="?", default=here / "build/release/tools", type=Path)
    parser.add_argument("-o", "--out", default=here / "build/tschamut", type=Path)
    parser.add_argument("--data", default=here / "../shared/data/experiments/tschamut2014", type=Path)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    seen = observed(args.data)
    slope = Slope(args.bin.resolve(), args.data.resolve(), args.out)
    every = range(len(slope.releases))

    n = N_A_RELEASE["final"]
    cases = [("observed, 18 runs", "", seen, "", (0, 0))]
    for name, setting, ground in (("meadow", "nothing fitted", MEADOW), ("firm", "30, 0.3", FIRM)):
        rows = slope.simulate(ground, "final")
        values = {q: quantity(rows, q, n, every) for q in QUANTITIES}
        cases.append((name, setting, values, f"{100 * lost_share(rows):.0f} %", interval(rows, n, seen)))
        if args.quick:
            break
    table(cases, seen)
    if args.quick:
        return
    (args.out / "tschamut.svg").write_text(picture(cases), encoding="utf-8")
    variants(slope, seen)

    grid = {(r, v): slope.simulate(MEADOW | {"rolling_resistance": r, "cor_half_speed_m_s": v})
            for r in ROLLING for v in HALF_SPEEDS}
    with open(args.out / "tschamut.csv", "w", encoding="utf-8") as file:
        file.write("rolling_resistance,cor_half_speed_m_s,mean_runout_m,distance_runout_m,distance_angle_deg\n")
        for (r, v), rows in grid.items():
            values = {q: quantity(rows, q, N_A_RELEASE["grid"], every) for q in QUANTITIES}
            file.write(f"{r},{v},{statistics.mean(values['run-out [m]']):.2f},"
                       + ",".join(f"{distance(values[q], seen[q]):.2f}" for q in QUANTITIES) + "\n")
    print(f"\nfitted to all: {best_setting(grid, seen, every)}")
    for begin in (0, 1):  # fitted to every second run, held against the others
        fitted, held = list(every)[begin::2], list(every)[1 - begin::2]
        setting = best_setting(grid, seen, fitted)
        apart = [distance(quantity(grid[s], "run-out [m]", N_A_RELEASE["grid"], held),
                          [seen["run-out [m]"][r] for r in held]) for s in (setting, (0.17, 10))]
        print(f"fitted to {len(fitted)} runs: {setting}; the other {len(held)}: {apart[0]:.1f} m apart, "
              f"with the meadow's own {apart[1]:.1f} m")
    for words in slope.broken:
        print(words)


if __name__ == "__main__":
    main()
