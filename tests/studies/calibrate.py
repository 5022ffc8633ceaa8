#!/usr/bin/env python3
"""Calibration on two field tests: which values of the soil the boulders do not contradict.

The sites are those of field.py, with terrain held level beyond the tracks. Two numbers of all soils are
drawn together: cor_half_energy_kj and bearing_kpa. Each run draws
both by a Sobol design, the same of both sites, so a run of one has the values of that run of the other.
`make calibrate` lets talus-batch compute the runs and judges them.

Left out are: each boulder; each half of the boulders, every other one; and each site, whose set is judged
by the boulders of the other.

The part `fit` is the table that the two numbers were chosen by: the same on all grounds, with fewer blocks.
"""
import csv
import itertools
import json
import os

import numpy as np

import field
from study import SOURCE, Study

RANGES = {"cor_half_energy_kj": (0.5, 8), "bearing_kpa": (1000, 16000)}
FITTED = {"cor_half_energy_kj": (1, 2, 4), "bearing_kpa": (2000, 4000, 8000)}
GROUNDS = {"tschamut": ["meadow"], "authume_P1": ["vegetated", "hard", "rocky", "beyond"]}
ROCKS = {"tschamut": 6, "authume_P1": 3}


def uncertainty(grounds):
    text = ""
    for key, (low, high) in RANGES.items():
        keys = json.dumps([f"ground.{ground}.{key}" for ground in grounds])
        text += f'[uncertainty.{key}]\nkeys = {keys}\ndistribution = "uniform"\nmin = {low}\nmax = {high}\n'
    return text


def observed(folder, **layers):
    """Sections of the site file, a layer each, whose points are written beside it."""
    for name, points in layers.items():
        with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(["x", "y", "start_x_m", "start_y_m"])
            rows.writerows(points)
    return "".join(f'[observed.{name}]\nboulders_file = "{name}.csv"\n' for name in layers)


def calibrated(slope, tools, n_runs):
    """Results of talus-calibrate for the runs of a site, with each half of the boulders left out in turn."""
    name = slope.name
    folder = tools.folder / name
    folder.mkdir(exist_ok=True)
    text = slope.text.replace("[output]\npassages = false\n", "[output]\n") + uncertainty(GROUNDS[name])
    ends = np.hstack([slope.starts + slope.seen, slope.starts])
    (folder / "site.toml").write_text(text + observed(folder, all=ends))
    (folder / "halves.toml").write_text(text + observed(folder, first=ends[::2], second=ends[1::2]))
    (folder / "Makefile").write_text(f"include {SOURCE}/pipelines/site.mk\n")
    tools.study.make(folder, f"RUNS={n_runs}", f"-j{os.cpu_count()}", f"DEM=../{name}_level_dem.tif",
                     "TRN_FLAGS=--crs none", "DDA_FLAGS=--settle", "calibrate")
    tools.run("talus-calibrate", f"{name}/halves.toml", f"{name}/out/runs", "--trn", f"{name}/out/trn.tif",
              "-o", f"{name}_halves.gpkg", "--json", f"{name}_halves.json")
    found, halves = (json.loads((tools.folder / file).read_text())["calibration"]
                     for file in (f"{name}/out/calibrate.json", f"{name}_halves.json"))
    return found | {"halves": halves["left_out_layers"]}


STUDY = Study(__file__, __doc__)
STUDY.words.add_argument("--runs", default=64, type=int)


@STUDY.part("sites", 1200)
def compute(study):
    study.need_data("experiments")
    tools, data = field.Tools(study), study.data / "experiments"
    found = {slope.name: calibrated(slope, tools, study.options.runs)
             for slope in (field.tschamut(tools, data / "tschamut2014", ROCKS["tschamut"]),
                           field.authume(tools, data / "authume_P1", ROCKS["authume_P1"]))}
    sets = {name: {run["seed"] for run in said["runs"] if run["implausibility"] <= said["most_implausible"]}
            for name, said in found.items()}
    for name, said in found.items():
        of_key = {key["key"].rpartition(".")[2]: key for key in said["keys"]}
        ranges = {f"{key} of the set": " to ".join(f"{float(f'{of_key[key][end]:.3g}'):g}" for end in ("set_low", "set_high"))
                  if said["n_plausible"] else "none" for key in RANGES}
        other, = (n for n in found if n != name)
        study.row("sites", name, {
            "runs": said["n_runs"], "not contradicted": said["n_plausible"], **ranges,
            "left-out boulders within": f"{said['left_out']['n_within']} of {said['left_out']['n']}",
            "a half left out contradicts": ", ".join(f"{half['n_contradicted']} of {half['n_plausible']}" for half in said["halves"]),
            "the other site contradicts": f"{len(sets[name] - sets[other])} of {len(sets[name])}"})


@STUDY.part("fit", 100)
def fit(study):
    tools, data = field.Tools(study), study.data / "experiments"
    slopes = field.tschamut(tools, data / "tschamut2014", 12), field.authume(tools, data / "authume_P1", 2)
    hits = field.Hits(tools, data)
    for values in itertools.product(*FITTED.values()):
        tools.more = [f"ground.{ground}.{key}={value}" for ground in ("meadow", "vegetated", "hard", "rocky", "beyond")
                      for key, value in zip(FITTED, values)]
        found = {}
        for slope in slopes:
            made = slope.figures("level")
            found |= {f"{slope.name}: mean [m]": f"{made['mean']:.0f}", f"{slope.name}: area [m]": f"{made['area']:.1f}",
                      f"{slope.name}: p90 - p10 [m]": f"{made['width']:.0f}",
                      f"{slope.name}: across over observed": f"{made['across']:.2f}"}
        kept = np.mean([hits.simulate(k)[:, 0].mean() for k in range(len(hits.hits))])
        study.row("fit", "{} kJ, {} kPa".format(*values), found | {"speed kept in hits": f"{kept:.2f}"})


if __name__ == "__main__":
    STUDY.main()
