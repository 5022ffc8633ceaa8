#!/usr/bin/env python3
"""Validation against 18 runs of the rockfall tests at Tschamut (2014): run-out and angle of reach.

  python3 tests/studies/tschamut.py [BIN] [-o FOLDER] [--data FOLDER] [--quick] [--reuse]

Each observed release is simulated with many blocks of its size and mass that start in random attitudes,
each alone, on the 5 m terrain that comes with the data. That terrain is interpolated from positions of
rolling blocks, so only distributions are compared. Blocks start where they were measured, up to 1.4 m
above that terrain, with the measured velocity; --settle lifts those that it would bury.

Printed are the tables of docs/evidence/validation.md, in its order:

- the slope on the way from each release to where its block lay;
- `soil = "meadow"` as it is, with nothing fitted, and firm ground with values of the literature, then the
  meadow on a terrain that goes on level behind the floor;
- the same by block, and with hulls of 8, 12 and 40 points, other friction, time steps and bearing;
- rolling resistance and half speed from a grid, held against the aims of the meadow;
- both fitted to one half of the runs and held against the other half, both ways round.

Intervals are of the runs drawn again, and of the blocks of each (bootstrap). Writes tschamut.csv (the grid)
and tschamut.svg (distributions). What --reuse finds in FOLDER is not computed again: for the same tools
only. --quick: the meadow alone.
"""
import argparse
import csv
import math
import random
import statistics
import subprocess
import sys
from pathlib import Path

FIRM = {"friction_deg": 30, "cor": 0.3}  # docs/evidence/validation.md says from where
MEADOW = {"soil": "meadow"}
ROLLING = (0.05, 0.08, 0.11, 0.14, 0.17, 0.20, 0.25, 0.30)
HALF_SPEEDS = (5, 10, 20)
POINTS = (8, 12, 20, 40)  # of the hulls
DENSITY_KG_M3 = 2650
N_BLOCKS = {"cases": 60, "variants": 12}  # a release
N_DRAWN = 500  # sets of runs and blocks drawn again
PADDING_M = 45  # of the terrain around the measured positions, metadata.json
AIMS = {"area": 16, "spread": (30, 65), "left": 0.10}  # of the meadow: m, m, share
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
        text += (f'[rockfall.{r["trajectory_id"]}]\nshape = "rock"\nn_points = {points}\n'
                 f'size_m = [{size["size_x_m"]}, {size["size_y_m"]}, {size["size_z_m"]}]\n'
                 f'volume_m3 = {float(r["mass_kg"]) / DENSITY_KG_M3:.6f}\n'
                 f'position_m = [[{r["x_m"]}, {r["y_m"]}, {r["z_m"]}]]\n'
                 f'velocity_m_s = [{r["vx_mps"]}, {r["vy_mps"]}, {r["vz_mps"]}]\n'
                 f'rocks = {n}\nseed = {int(r["trajectory_id"][1:])}\n')
    return text


class Heights:
    """Heights of the terrain, bilinear between the centres of its cells."""

    def __init__(self, path):
        lines = path.read_text().splitlines()
        self.head = lines[:6]
        named = {name: float(value) for name, value in (line.split() for line in self.head)}
        self.west, self.south, self.cell = named["xllcorner"], named["yllcorner"], named["cellsize"]
        self.z = [[float(word) for word in line.split()] for line in lines[6:]]

    def at(self, x, y):
        column = (x - self.west) / self.cell - 0.5
        row = len(self.z) - 0.5 - (y - self.south) / self.cell
        i, j = int(row), int(column)
        below, right = row - i, column - j
        upper, lower = ((1 - right) * self.z[k][j] + right * self.z[k][j + 1] for k in (i, i + 1))
        return (1 - below) * upper + below * lower

    def holds(self, x, y):
        east, north = (x - self.west) / self.cell - 0.5, (y - self.south) / self.cell - 0.5
        return 0 <= east < len(self.z[0]) - 1 and 0 < north <= len(self.z) - 1

    def no_lower_than(self, least):
        return [[max(z, least) for z in row] for row in self.z]

    def level_outside(self, n):
        """Heights whose outer `n` cells are those of the nearest cell within."""
        inner = lambda k, size: min(max(k, n), size - 1 - n)
        rows, columns = len(self.z), len(self.z[0])
        return [[self.z[inner(i, rows)][inner(j, columns)] for j in range(columns)] for i in range(rows)]

    def write(self, z, path):
        path.write_text("\n".join([*self.head, *(" ".join(f"{x:.6f}" for x in row) for row in z)]) + "\n")


class Slope:
    """Terrain and releases, simulated on any ground."""

    def __init__(self, tools, data, folder, reuse=False):
        self.tools, self.folder, self.reuse, self.broken = tools, folder, reuse, []
        self.releases = rows_of(data / "release_points.csv")
        self.sizes = {r["block_id"]: r for r in rows_of(data / "block_metadata.csv")}
        self.heights = Heights(data / "terrain.asc")
        lowest = min(float(r["ground_z_m"]) for r in rows_of(data / "observed_deposition.csv"))
        terrains = {"trn": self.heights.z, "level": self.heights.no_lower_than(lowest),
                    "border": self.heights.level_outside(round(PADDING_M / self.heights.cell))}
        for name, z in terrains.items():
            self.heights.write(z, folder / f"{name}.asc")
            self.run("talus-trn", f"{name}.asc", "-o", f"{name}.tif", "--crs", "none")

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

    def simulate(self, ground, n="variants", points=20, *more, trn="trn"):
        """Rows of talus-runout, a list a release with a row a block; kept in the folder."""
        name = self.blocks(N_BLOCKS[n], points)
        words = [w for key, value in ground.items() for w in ("--set", f"ground.meadow.{key}={value}")] + list(more)
        said = [w.replace("ground.meadow.", "") for w in words if w != "--set"]
        kept = "__".join([name, *([] if trn == "trn" else [trn]), *said]) + ".csv"
        if not (self.reuse and (self.folder / kept).exists()):
            self.run("talus-dda", f"{name}.toml", "--trn", f"{trn}.tif", "--blocks", f"{name}.h5", "-o", "run.h5",
                     "--settle", "--set", "output.frame_interval_s=1", "--set", "output.passages=false", *words)
            self.run("talus-runout", "run.h5", "--trn", f"{trn}.tif", "-o", "run.gpkg", "--tables", ".")
            (self.folder / "runout.csv").replace(self.folder / kept)
        rows = rows_of(self.folder / kept)
        return [rows[k:k + N_BLOCKS[n]] for k in range(0, len(rows), N_BLOCKS[n])]


def observed(data):
    """Run-out and angle of reach of each run, as the deposit's positions give them."""
    out = {name: [] for name in QUANTITIES}
    for row in rows_of(data / "observed_deposition.csv"):
        drop = float(row["release_z_m"]) - float(row["z_m"])
        length = float(row["observed_runout_m"])
        out["run-out [m]"].append(length)
        out["angle of reach [deg]"].append(math.degrees(math.atan2(drop, length)))
    return out


def values_of(rows, name="run-out [m]"):
    """Values of `name`, a list a release."""
    return [[float(row[QUANTITIES[name]]) for row in of_release] for of_release in rows]


def together(lists):
    return [x for values in lists for x in values]


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


def area(lists, seen, runs, drawn=None):
    """Area between the distributions of run-out of `runs`; `drawn`: indices of blocks, a list a run."""
    if drawn is None:
        values = together(lists[r] for r in runs)
    else:
        values = [lists[r][k] for r, blocks in zip(runs, drawn) for k in blocks]
    return distance(values, [seen["run-out [m]"][r] for r in runs])


def best_setting(grid, seen, runs, drawn=None):
    """Setting whose run-outs of `runs` lie nearest to those seen."""
    return min(grid, key=lambda setting: area(grid[setting], seen, runs, drawn))


def drawn_again(draw, runs, n):
    """As many of the runs, and of the `n` blocks of each, with repetition."""
    chosen = [runs[draw.randrange(len(runs))] for _ in runs]
    return chosen, [draw.choices(range(n), k=n) for _ in chosen]


def middle_95(values):
    return percentile(values, 0.025), percentile(values, 0.975)


def interval(lists, seen):
    """95 % of the area between the distributions of run-out, of runs and blocks drawn again."""
    draw = random.Random(1)
    return middle_95([area(lists, seen, *drawn_again(draw, range(len(lists)), len(lists[0]))) for _ in range(N_DRAWN)])


def interval_of_mean(lists):
    """95 % of the mean run-out, of the blocks alone drawn again."""
    draw = random.Random(2)
    return middle_95([statistics.mean(together(draw.choices(blocks, k=len(blocks)) for blocks in lists))
                      for _ in range(N_DRAWN)])


# --- what is shown ---------------------------------------------------------------------------------

def lost_share(rows):
    return statistics.mean(row["fate"] == "left_domain" for row in together(rows))


def figures(values):
    return [statistics.mean(values)] + [percentile(values, p) for p in (0.1, 0.5, 0.9)]


def spread(values):
    return percentile(values, 0.9) - percentile(values, 0.1)


def head(*words):
    print("\n| " + " | ".join(words) + " |\n|" + "---|" * len(words))


def line(*words):
    print("| " + " | ".join(str(word) for word in words) + " |")


def slope_table(slope, deposits):
    """Slope along the line from each release to where its block lay; where the floor ends, a release."""
    head("run", "block", "start above the terrain, m", "cell of the start, degrees", "first 20 m", "20 to 50 m",
         "floor, below 10 degrees", "the 20 m behind it", "border")
    ends = []
    for r, d in zip(slope.releases, deposits):
        x, y = float(r["x_m"]), float(r["y_m"])
        dx, dy = float(d["x_m"]) - x, float(d["y_m"]) - y
        length = math.hypot(dx, dy)
        on_line = lambda way: (x + dx / length * way, y + dy / length * way)
        border = next(way for way in range(0, 999, 5) if not slope.heights.holds(*on_line(way)))
        z = [slope.heights.at(*on_line(way)) for way in range(0, border, 5)]
        fall = lambda begin, end: math.degrees(math.atan((z[begin // 5] - z[end // 5]) / (end - begin)))
        floor = next(way for way in range(0, border, 5) if fall(way, way + 10) < 10)
        behind = next((way for way in range(floor, border - 15, 5) if fall(way, way + 10) >= 10), None)
        half, at = slope.heights.cell / 2, slope.heights.at
        start = math.degrees(math.atan(math.hypot(at(x + half, y) - at(x - half, y), at(x, y + half) - at(x, y - half))
                                       / slope.heights.cell))
        steep = "-" if behind is None else f"{fall(behind, min(behind + 20, 5 * len(z) - 5)):.0f}"
        line(r["trajectory_id"], r["block_id"],
             f"{float(r['z_m']) - float(r['radius_m']) - at(x, y):.1f}", f"{start:.0f}",
             f"{fall(0, 20):.0f}", f"{fall(20, 50):.0f}", f"{floor} to {behind or border} m", steep, f"{border} m")
        ends.append(behind or border)
    return ends


def table(cases, seen):
    """Rows of Markdown: each set of parameters beside what was seen; lost: left the terrain."""
    head("", "ground", "quantity", "mean", "p10", "p50", "p90", "p90 - p10",
         "area between the distributions (95 %)", "left the terrain")
    for name, setting, values, lost, (low, high) in cases:
        for q, list_of in values.items():
            apart = "" if list_of is seen[q] else f"{distance(list_of, seen[q]):.1f}"
            if apart and q == "run-out [m]":
                apart += f" ({low:.1f} to {high:.1f})"
            line(name, setting, q, *(f"{x:.1f}" for x in figures(list_of)), f"{spread(list_of):.0f}", apart, lost)


def block_table(slope, lists, seen):
    head("block", "runs", "observed mean, least and largest", "meadow: mean", "p10", "p50", "p90")
    for block, size in slope.sizes.items():
        runs = [k for k, r in enumerate(slope.releases) if r["block_id"] == block]
        of_runs = [seen["run-out [m]"][r] for r in runs]
        sides = " x ".join(f"{float(size[f'size_{axis}_m']):.2f}" for axis in "xyz")
        line(f"{block}: {float(size['mass_kg']):.0f} kg, {sides} m", len(runs),
             f"{statistics.mean(of_runs):.0f}, {min(of_runs):.0f} and {max(of_runs):.0f}",
             *(f"{x:.0f}" for x in figures(together(lists[r] for r in runs))))


def variants(slope, seen):
    """How far the meadow runs out with other shapes, friction and steps: rows of Markdown."""
    head("hull, ground, step", "mean (95 %, of the blocks)", "p10", "p50", "p90", "area", "left the terrain")
    kinds = [(f"{p} points", MEADOW, p, ()) for p in POINTS]
    kinds += [(f"{p} points, no rolling resistance", MEADOW | {"rolling_resistance": 0}, p, ()) for p in POINTS]
    kinds += [(f"friction {f} degrees", MEADOW | {"friction_deg": f}, 20, ()) for f in (31, 39, 45)]
    kinds += [(f"step {h} s", MEADOW, 20, ("--set", f"solver.time_step_s={h}"))
              for h in (0.0025, 0.00125)]
    kinds += [(f"bearing {q} kPa", MEADOW | {"bearing_kpa": q}, 20, ()) for q in (50, 82, 200)]
    for words, ground, points, more in kinds:
        rows = slope.simulate(ground, "variants", points, *more)
        lists = values_of(rows)
        mean, *rest = figures(together(lists))
        low, high = interval_of_mean(lists)
        line(words, f"{mean:.0f} ({low:.0f} to {high:.0f})", *(f"{x:.0f}" for x in rest),
             f"{distance(together(lists), seen['run-out [m]']):.1f}", f"{100 * lost_share(rows):.0f} %")


def grid_table(grid, seen, path):
    """Each setting: area, spread and share that left the terrain; also as CSV."""
    head("rolling resistance", *(f"half speed {v} m/s: area, p90 - p10, left" for v in HALF_SPEEDS))
    figures_of = {}
    for setting, rows in grid.items():
        values = together(values_of(rows))
        figures_of[setting] = distance(values, seen["run-out [m]"]), spread(values), lost_share(rows)
    for r in ROLLING:
        row = [figures_of[r, v] for v in HALF_SPEEDS]
        line(r, *(f"{a:.1f} m, {s:.0f} m, {100 * left:.0f} %" for a, s, left in row))
    low, high = AIMS["spread"]
    held = {s: (f[0] <= AIMS["area"], low <= f[1] <= high, f[2] <= AIMS["left"]) for s, f in figures_of.items()}
    for words, which in (("area", 0), ("p90 - p10", 1), ("left the terrain", 2)):
        print(f"{words}: the aim is met by {sum(h[which] for h in held.values())} of {len(held)}")
    print("all three:", [s for s, h in held.items() if all(h)] or "none")
    with open(path, "w", encoding="utf-8") as file:
        file.write("rolling_resistance,cor_half_speed_m_s,mean_runout_m,area_m,spread_m,left_share\n")
        for (r, v), (a, s, left) in figures_of.items():
            file.write(f"{r},{v},{statistics.mean(together(values_of(grid[r, v]))):.2f},{a:.2f},{s:.2f},{left:.3f}\n")


def halves_table(grid, firm, seen):
    """Fitted to one half of the runs, held against the other."""
    every, n = list(range(len(firm))), len(firm[0])
    meadow, words = grid[0.17, 10], lambda x, between: f"{x:.1f} ({between[0]:.1f} to {between[1]:.1f})"
    head("fitted to", "rolling resistance, half speed", "area there", "area on the other half (95 %)",
         "the meadow as it is, there", "firm ground, there", "fitted less meadow")
    often_chosen = []
    for fitted, held, name in ((every[::2], every[1::2], "A"), (every[1::2], every[::2], "B")):
        setting, draw = best_setting(grid, seen, fitted), random.Random(3)
        drawn, chosen = [], {}
        for _ in range(N_DRAWN):
            best = best_setting(grid, seen, *drawn_again(draw, fitted, n))
            chosen[best] = chosen.get(best, 0) + 1
            others = drawn_again(draw, held, n)
            drawn.append([area(lists, seen, *others) for lists in (grid[best], meadow, firm)])
        best, plain, hard = (area(lists, seen, held) for lists in (grid[setting], meadow, firm))
        line(f"half {name}, {len(fitted)} runs", f"{setting[0]}, {setting[1]} m/s",
             f"{area(grid[setting], seen, fitted):.1f}",
             *(words(x, middle_95([d[k] for d in drawn])) for k, x in enumerate((best, plain, hard))),
             words(best - plain, middle_95([d[0] - d[1] for d in drawn])))
        often = sorted(chosen.items(), key=lambda item: -item[1])[:4]
        often_chosen.append(f"half {name} drawn again chooses "
                            + ", ".join(f"{s}: {100 * n / N_DRAWN:.0f} %" for s, n in often))
    print("", *often_chosen, sep="\n")
    runs = seen["run-out [m]"]
    print(f"\nwhat was observed in one half, beside the other: {distance(runs[::2], runs[1::2]):.1f} m apart; "
          f"fitted to all: {best_setting(grid, seen, every)}")
    draw, drawn = random.Random(4), []
    for _ in range(N_DRAWN):
        mixed = draw.sample(every, len(every))
        fitted, held = mixed[:len(every) // 2], mixed[len(every) // 2:]
        best = best_setting(grid, seen, fitted)
        drawn.append([area(lists, seen, held) for lists in (grid[best], meadow, firm)]
                     + [distance([runs[r] for r in fitted], [runs[r] for r in held])])
    for k, name in enumerate(("fitted", "the meadow as it is", "firm ground", "observed of the fitted half")):
        values = [d[k] for d in drawn]
        print(f"{N_DRAWN} halves drawn at random, {name} on the other half: median "
              + words(percentile(values, 0.5), middle_95(values)))


COLOURS = ("#222222", "#c1272d", "#0057a8", "#e69f00")


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
    out = ('<svg xmlns="http://www.w3.org/2000/svg" width="760" height="350" font-family="sans-serif" '
           'font-size="12"><rect width="760" height="350" fill="white"/>')
    for k, (name, setting, *_) in enumerate(cases):
        words = f"{name} ({setting})" if setting else name
        x, y = 60 + 365 * (k % 2), 16 + 18 * (k // 2)
        out += (f'<path d="M{x} {y}h20" stroke="{COLOURS[k]}" stroke-width="2"/>'
                f'<text x="{x + 25}" y="{y + 4}">{words}</text>')
    out += '<g transform="translate(0 18)">'
    for k, (q, ticks) in enumerate(zip(QUANTITIES, ([0, 50, 100, 150, 200], [15, 20, 25, 30, 35, 40]))):
        out += panel(60 + 365 * k, q, [case[2][q] for case in cases], ticks)
    return out + "</g></svg>\n"


def main():
    here = Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("bin", nargs="?", default=here / "build/release/tools", type=Path)
    parser.add_argument("-o", "--out", default=here / "build/tschamut", type=Path)
    parser.add_argument("--data", default=here / "../shared/data/experiments/tschamut2014", type=Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--reuse", action="store_true")
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    seen = observed(args.data)
    slope = Slope(args.bin.resolve(), args.data.resolve(), args.out, args.reuse)
    floor_ends = slope_table(slope, rows_of(args.data / "observed_deposition.csv"))

    cases = [("observed, 18 runs", "", seen, "", (0, 0))]
    lists = {}
    kinds = (("meadow", "nothing fitted", MEADOW, "trn"), ("firm", "30 degrees, 0.3", FIRM, "trn"),
             ("meadow, outer 45 m level", "nothing fitted", MEADOW, "border"),
             ("meadow, no lower than the lowest deposit", "nothing fitted", MEADOW, "level"))
    for name, setting, ground, trn in kinds[:1] if args.quick else kinds:
        rows = slope.simulate(ground, "cases", trn=trn)
        values = {q: together(values_of(rows, q)) for q in QUANTITIES}
        lists[name, trn] = values_of(rows)
        cases.append((name, setting, values, f"{100 * lost_share(rows):.1f} %",
                      interval(values_of(rows), seen)))
    table(cases, seen)
    farthest = max(seen["run-out [m]"])
    print()
    for (name, _), of in lists.items():
        beyond = statistics.mean(x > farthest for x in together(of))
        behind = statistics.mean(x > end for end, values in zip(floor_ends, of) for x in values)
        short = statistics.mean(x < 5 for x in together(of))
        print(f"{name}: {100 * beyond:.0f} % go farther than any of the 18 ({farthest:.0f} m), "
              f"{100 * behind:.0f} % than the floor reaches, {100 * short:.0f} % less than 5 m")
    block_table(slope, lists["meadow", "trn"], seen)
    if args.quick:
        return
    (args.out / "tschamut.svg").write_text(picture(cases[:4]), encoding="utf-8")
    variants(slope, seen)
    grid = {(r, v): slope.simulate(MEADOW | {"rolling_resistance": r, "cor_half_speed_m_s": v})
            for r in ROLLING for v in HALF_SPEEDS}
    grid_table(grid, seen, args.out / "tschamut.csv")
    halves_table({s: values_of(rows) for s, rows in grid.items()}, values_of(slope.simulate(FIRM)), seen)
    for words in slope.broken:
        print(words)


if __name__ == "__main__":
    main()
