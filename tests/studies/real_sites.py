#!/usr/bin/env python3
"""Four sample sites with data beside the checkout, as slides of touching blocks, from contours to fence.

Ten seeds a site with friction scattered by 2 degrees, joints and fences as in the site files, 60 s. A run that breaks
a limit of its health is evaluated all the same, and counted.

Each site is compared with its scenario: L is measured along the expected path, and the energy line of 28 degrees ends
where it says. Of the volume at rest half lies below L50.
"""
import json
import math
import re
import statistics

import h5py
import numpy
from osgeo import gdal

from study import SOURCE, Study

gdal.UseExceptions()
SITES = ("lechtal_kotcliff", "gschnitz_gar", "lechtal_kotdam", "salisbury_crags")
RUNS = 10
COSTS = {"lechtal_kotcliff": 600, "gschnitz_gar": 500, "lechtal_kotdam": 800, "salisbury_crags": 1500}
ROCK = '''
[rockfall.rock]
shape = "rock"
size_m = [1.2, 1.0, 0.8]
polygon_file = "{data}/scenarios/{site}.gpkg|layername=release"
release_spacing_m = {spacing:.2f}
height_above_ground_m = 0.5
'''


def scenario_of(study, site):
    study.need_data(f"scenarios/{site}.json", f"scenarios/{site}.gpkg")
    return json.loads((study.data / f"scenarios/{site}.json").read_text())


def area_of(ring):
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))) / 2


def write_rock_site(study, site, folder, rocks, left_out, more, ground=""):
    """The sample site with rocks instead of its mass, `rocks` to the area of the release polygon in plan, without the
    sections `left_out`, and with `more`."""
    kept, text = True, ""
    for line in (SOURCE / f"sample_sites/{site}/site.toml").read_text().splitlines(keepends=True):
        if line.startswith("["):
            kept = not re.match(rf"\[({left_out})", line)
        if kept and not re.match("failure_surface|depth_m", line):
            text += line.replace("../../../shared/data", str(study.data))
        if line.startswith("[ground.slope]"):
            text += ground
    spacing = math.sqrt(area_of(scenario_of(study, site)["release"]["polygon"]) / rocks)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "site.toml").write_text(text + ROCK.format(data=study.data, site=site, spacing=spacing) + more)
    makefile = (SOURCE / f"sample_sites/{site}/Makefile").read_text()
    (folder / "Makefile").write_text(makefile.replace("../../../shared/data", str(study.data))
                                     .replace("../../pipelines", str(SOURCE / "pipelines")))


def band(path, name):
    raster = gdal.Open(str(path))
    for i in range(1, raster.RasterCount + 1):
        if raster.GetRasterBand(i).GetDescription() == name:
            return raster.GetRasterBand(i).ReadAsArray(), raster.GetGeoTransform()
    raise SystemExit(f"{path}: no band {name}")


def along_path(path, points):
    """L of the nearest place on the path, and the distance from it, for each point (n, 2)."""
    best, length, start = numpy.full(len(points), numpy.inf), numpy.zeros(len(points)), 0.0
    for a, b in zip(path[:-1], path[1:]):
        leg = b - a
        size = float(numpy.hypot(*leg))
        t = numpy.clip((points - a) @ leg / size**2, 0, 1)
        away = numpy.hypot(*(points - a - t[:, None] * leg).T)
        nearer = away < best
        best[nearer] = away[nearer]
        length[nearer] = start + t[nearer] * size
        start += size
    return length, best


def centres(mask, transform):
    rows, cols = numpy.nonzero(mask)
    return numpy.column_stack([transform[0] + (cols + 0.5) * transform[1], transform[3] + (rows + 0.5) * transform[5]])


def beside_scenario(scenario, out):
    """How far the runs in `out` went, where they lie and the effect of the fence."""
    runout, fences = (json.loads((out / name).read_text()) for name in ("runout.json", "fence.json"))
    path = numpy.array([p[:2] for p in scenario["path"]["points"]], float)
    passed, transform = band(out / "maps/reach.tif", "n_pass")
    length, away = along_path(path, centres(passed > 0, transform))
    thick, _ = band(out / "maps/deposit.tif", "deposit_thickness")
    rest = thick > 0
    at, _ = along_path(path, centres(rest, transform))
    order = numpy.argsort(at)
    volume = numpy.cumsum(thick[rest][order]) / thick[rest].sum()
    balance = runout["balance"]
    stopped = sum(fence["verdicts"]["stopped"]["n"] for fence in fences["fences"])
    over = sum(verdict["n"] for fence in fences["fences"] for name, verdict in fence["verdicts"].items()
               if name not in ("stopped", "not_reached"))
    return {"passed up to L [m]": f"{length.max():.0f}",
            "energy line of 28 degrees at L [m]": f"{scenario['energy_line_stops']['28']['L']:.0f}",
            "from the path, median [m]": f"{numpy.median(away):.0f}",
            "at rest [%]": f"{100 * balance['deposited_m3'] / balance['released_m3']:.0f}",
            "L50 [m]": f"{at[order][numpy.searchsorted(volume, 0.5)]:.0f}",
            "stopped by the fence": f"{stopped:.0f}", "past it": f"{over:.0f}"}


def runs_of(study, out):
    """Of the runs in `out`: how many, how many broke a limit of their health, their CPU seconds."""
    failed = 0
    files = sorted((out / "runs").glob("run_*.h5"))
    for file in files:
        with h5py.File(file) as run:
            failed += run.attrs["status"] == b"failed"
    said = json.loads(study.run("talus-runs", "--db", out / "runs.sqlite", "list", "--json"))["runs"]
    return len(files), failed, [run["cpu_time_s"] for run in said if run["tool"] == "talus-dda"]


STUDY = Study(__file__, __doc__)


def evaluate(study, site, folder, out, *flags):
    study.make(folder, f"OUT={out}", "WITHOUT=no", *flags, "runs", keep_going=True)
    # a run that breaks a limit of its health keeps its file, and make takes it as made the second time
    study.make(folder, f"OUT={out}", "WITHOUT=no", *flags, "maps", "runout", "fence", keep_going=True)
    n, failed, cpu_s = runs_of(study, out)
    blocks = json.loads((out / "blocks.json").read_text())["n_blocks"]
    study.row("sites", site, {"blocks": blocks, "runs": n, "broke a limit": failed,
                            "CPU s a run": tuple(f"{x:.1f}" for x in (statistics.median(cpu_s), min(cpu_s), max(cpu_s))),
                            **beside_scenario(scenario_of(study, site), out)})


def slide(study, site):
    scenario_of(study, site)
    evaluate(study, site, SOURCE / f"sample_sites/{site}", study.out / site, f"RUNS={RUNS}",
             "DDA_FLAGS=--set solver.friction_scatter_deg=2")


for one in SITES:
    STUDY.part(one, COSTS[one])(lambda study, site=one: slide(study, site))

if __name__ == "__main__":
    STUDY.main()
