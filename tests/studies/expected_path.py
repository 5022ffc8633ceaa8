"""expected_path.py SCENARIO.json OUT: a site's results beside what its scenario expects.

SCENARIO.json holds the expected path (x, y, z every 50 m), the places where energy lines of given
angles meet the ground (`energy_line_stops`, L along the path), and objects; OUT is the folder that
make wrote. Prints one line each: how far along the path cells were passed, beside the energy lines;
how far from the path; where the deposit lies; what passed each object; the verdicts at each fence.
"""
import json
import os
import sys

import numpy
from osgeo import gdal

gdal.UseExceptions()


def band(path, name):
    raster = gdal.Open(path)
    for i in range(1, raster.RasterCount + 1):
        if raster.GetRasterBand(i).GetDescription() == name:
            return raster.GetRasterBand(i).ReadAsArray(), raster.GetGeoTransform()
    raise SystemExit(f"{path}: no band {name}")


def along_path(path, points):
    """L of the nearest place on the path, and the distance from it, for each point (n, 2)."""
    best = numpy.full(len(points), numpy.inf)
    length = numpy.zeros(len(points))
    start = 0.0
    for a, b in zip(path[:-1], path[1:]):
        way = b - a
        size = float(numpy.hypot(*way))
        t = numpy.clip((points - a) @ way / size**2, 0, 1)
        away = numpy.hypot(*(points - a - t[:, None] * way).T)
        nearer = away < best
        best[nearer] = away[nearer]
        length[nearer] = start + t[nearer] * size
        start += size
    return length, best


def centres(mask, transform):
    rows, cols = numpy.nonzero(mask)
    return numpy.column_stack([transform[0] + (cols + 0.5) * transform[1],
                               transform[3] + (rows + 0.5) * transform[5]])


def on_line(values, transform, line):
    """Largest value of the cells below a line."""
    line = numpy.array(line, float)
    largest = 0.0
    for a, b in zip(line[:-1], line[1:]):
        for t in numpy.linspace(0, 1, 2 + int(numpy.hypot(*(b - a)) / transform[1] * 4)):
            x, y = a + t * (b - a)
            row, col = int((y - transform[3]) / transform[5]), int((x - transform[0]) / transform[1])
            if 0 <= row < values.shape[0] and 0 <= col < values.shape[1]:
                largest = max(largest, float(values[row, col]))
    return largest


def main(scenario_file, out):
    with open(scenario_file, encoding="utf-8") as file:
        scenario = json.load(file)
    with open(f"{out}/runout.json", encoding="utf-8") as file:
        runout = json.load(file)
    path = numpy.array([p[:2] for p in scenario["path"]["points"]], float)
    passed, transform = band(f"{out}/maps/reach.tif", "n_pass")
    share, _ = band(f"{out}/maps/reach.tif", "run_share")
    length, away = along_path(path, centres(passed > 0, transform))
    stops = {angle: stop["L"] for angle, stop in scenario["energy_line_stops"].items()}
    runs = runout["runs"]
    print(f"{scenario['name']}: {len(runs)} runs, {runout['balance']['n_released']} blocks, "
          f"health {runout['tags']['HEALTH']}")
    often = along_path(path, centres(share >= 0.5, transform))[0]
    print(f"  passed up to L = {length.max():.0f} m of {scenario['path']['length_m']}, in half of the runs up to "
          f"{often.max():.0f} m; energy lines end at " +
          ", ".join(f"{stop:.0f} m ({angle} deg)" for angle, stop in stops.items()))
    print(f"  passed cells lie {numpy.median(away):.0f} m from the path (median), 95 % within "
          f"{numpy.percentile(away, 95):.0f} m, all within {away.max():.0f} m")
    thick, _ = band(f"{out}/maps/deposit.tif", "deposit_thickness")
    rest = thick > 0
    at, _ = along_path(path, centres(rest, transform))
    order = numpy.argsort(at)
    volume = numpy.cumsum(thick[rest][order]) / thick[rest].sum()
    half, most = (at[order][numpy.searchsorted(volume, share)] for share in (0.5, 0.95))
    b = runout["balance"]
    print(f"  at rest {b['deposited_m3'] / b['released_m3']:.1%} of the volume, half of it at L below "
          f"{half:.0f} m, 95 % below {most:.0f} m; moving {b['moving_m3'] / b['released_m3']:.1%}, left the "
          f"terrain {b['left_domain_m3'] / b['released_m3']:.1%}")
    spread = runout["spread_over_runs"]
    print("  " + ", ".join(f"{name} {spread[key]['mean']:.3g} ({spread[key]['min']:.3g} to {spread[key]['max']:.3g})"
                           for key, name in (("H_m", "H"), ("L_path_m", "L"), ("reach_angle_path_deg", "angle of reach"),
                                             ("H_cm_over_L_cm", "H/L of the centre of mass"))))
    for thing in scenario["objects"]:
        print(f"  {thing['name']}: passed by {on_line(passed, transform, thing['line']):.0f} blocks in a cell, "
              f"by {on_line(share, transform, thing['line']):.0%} of the runs")
    if os.path.exists(f"{out}/fence.json"):
        with open(f"{out}/fence.json", encoding="utf-8") as file:
            for fence in json.load(file)["fences"]:
                counts = {name: v["n"] for name, v in fence["verdicts"].items() if v["n"] > 0}
                print(f"  fence {fence['name']}: " + ", ".join(f"{n} {name}" for name, n in counts.items()))


main(*sys.argv[1:3])
