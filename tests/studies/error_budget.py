#!/usr/bin/env python3
"""Error budget of the hazard classes: how far their boundaries move when one input or setting changes.

Two sample sites, a slide (maungawhau) and rocks one by one (crater_rocks). Each row is the site with one change, held
against the site as it is, for the area of any class and for that of the classes from "blue" upwards. The displacement
of a boundary is the area that changed sides over the length of the boundary [m]; outward where the area grew. The
farthest is the 95th percentile of the distance of the changed cells from the old boundary. Row "other seeds" is
the effect of chance: changes below it are not significant.
"""
import re

import numpy
from osgeo import gdal
from scipy.ndimage import distance_transform_edt

from study import SOURCE, Study

gdal.UseExceptions()
BOUNDARIES = {"any class": 1, "blue and red": 3}  # from which code of the class map
# site -> change -> (text of site.toml, its replacement) or variables of make; the cost of a change
CHANGES = {
    "maungawhau": (40, {
        "other seeds": {"SEED": 1001},
        "5 times the runs": {"RUNS": 100},
        "cells of 5 m": ("cell_size_m = 2.5", "cell_size_m = 5"),
        "cells of 1.25 m": ("cell_size_m = 2.5", "cell_size_m = 1.25"),
        "half the step": ("[solver]\n", "[solver]\ntime_step_s = 0.0025\n"),
        "ground friction -2 degrees": ("friction_deg = 22", "friction_deg = 20"),
        "ground friction +2 degrees": ("friction_deg = 22", "friction_deg = 24"),
        "ground restitution 0.2": ("cor = 0.3", "cor = 0.2"),
        "joint spacing 1.5 m": ("spacing_m = 2\n", "spacing_m = 1.5\n"),
        "joint spacing 3 m": ("spacing_m = 2\n", "spacing_m = 3\n"),
        "half the frequency": ("frequency_per_a = 0.01", "frequency_per_a = 0.005")}),
    "crater_rocks": (60, {
        "other seeds": {"SEED": 1001},
        "3 times the runs": {"RUNS": 30},
        "cells of 5 m": ("cell_size_m = 2.5", "cell_size_m = 5"),
        "cells of 1.25 m": ("cell_size_m = 2.5", "cell_size_m = 1.25"),
        "half the step": ("[solver]\n", "[solver]\ntime_step_s = 0.0025\n"),
        "soil soft_soil": ('soil = "meadow"', 'soil = "soft_soil"'),
        "soil rock": ('soil = "meadow"', 'soil = "rock"'),
        "largest rock 1 m3": ("volume_max_m3 = 2", "volume_max_m3 = 1"),
        "largest rock 4 m3": ("volume_max_m3 = 2", "volume_max_m3 = 4"),
        "shape eota111": ('shape = "rock"\nsize_m = [1.2, 1.0, 0.8]', 'shape = "eota111"'),
        "half the frequency": ("frequency_per_a = 0.5 ", "frequency_per_a = 0.25 ")}),
}
STUDY = Study(__file__, __doc__)


def classes(study, site, name, change):
    """The class map of the site with a change."""
    folder = study.out / site / re.sub(r"\W+", "_", name)
    folder.mkdir(parents=True, exist_ok=True)
    origin = SOURCE / "sample_sites" / site
    text = (origin / "site.toml").read_text()
    words = [f"{key}={value}" for key, value in change.items()] if isinstance(change, dict) else []
    if isinstance(change, tuple):
        if change[0] not in text:
            raise SystemExit(f"{site}: site.toml does not hold {change[0]!r}")
        text = text.replace(*change)
    contours = SOURCE / "sample_sites/maungawhau/contours.gpkg"
    (folder / "site.toml").write_text(re.sub(r'contours = ".*"', f'contours = "{contours}"', text))
    (folder / "Makefile").write_text(f"include {SOURCE}/pipelines/site.mk\n")
    study.make(folder, "hazard", "DB=--no-db", "CHECK_FLAGS=--accept-doubts", *words)
    return folder / "out/hazard/class.tif"


def cells_of(path, like):
    """The codes of a class map on the cells of another, 0 without a class, and the side of a cell [m]."""
    base = gdal.Open(str(like))
    x, side, _, y, _, _ = base.GetGeoTransform()
    bounds = (x, y - side * base.RasterYSize, x + side * base.RasterXSize, y)
    here = gdal.Warp("", str(path), format="MEM", outputBounds=bounds, xRes=side, yRes=side, resampleAlg="near")
    codes = here.GetRasterBand(1).ReadAsArray()
    return numpy.where(codes == 255, 0, codes), side


def edges(area):
    """Sides of cells between an area and the rest."""
    padded = numpy.pad(area, 1).astype(int)
    return abs(numpy.diff(padded, axis=0)).sum() + abs(numpy.diff(padded, axis=1)).sum()


def displacement(before, after, side):
    """Of a boundary: mean, mean outward, farthest [m]. The length of a line is pi/4 of the cell sides that it crosses."""
    changed = before ^ after
    length = edges(before) * side * numpy.pi / 4
    outward = (after.sum() - before.sum()) * side**2 / length
    depth = numpy.where(before, distance_transform_edt(before), distance_transform_edt(~before)) * side
    farthest = numpy.percentile(depth[changed], 95) if changed.any() else 0
    return changed.sum() * side**2 / length, outward, farthest


def add_part(site, cost_s, name, change):
    @STUDY.part(re.sub(r"\W+", "_", f"{site} {name}"), cost_s)
    def compute(study):
        base_map = classes(study, site, "as it is", None)
        (base, side), (codes, _) = (cells_of(path, base_map) for path in (base_map, classes(study, site, name, change)))
        for title, lowest in BOUNDARIES.items():
            mean, outward, farthest = displacement(base >= lowest, codes >= lowest, side)
            study.row(site, name, {f"{title}: mean [m]": f"{mean:.1f}", f"{title}: outward [m]": f"{outward:+.1f}",
                                   f"{title}: farthest [m]": f"{farthest:.1f}"})


for SITE, (COST_S, CHANGED) in CHANGES.items():
    for NAME, CHANGE in CHANGED.items():
        add_part(SITE, COST_S, NAME, CHANGE)

if __name__ == "__main__":
    STUDY.main()
