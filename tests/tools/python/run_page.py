#!/usr/bin/env python3
"""Executes the Python of a page, and compares its values of the runs of a folder with closed forms.

  run_page.py PAGE.md FOLDER

Boxes slide from rest down a plane of 30 degrees: at a horizontal distance d their speed is
sqrt(2 g (sin 30 - cos 30 tan friction) d / cos 30). The page's measured profile has those speeds.
"""
import math
import os
import re
import sys

import h5py
import numpy as np

with open(sys.argv[1], encoding="utf-8") as file:
    page = file.read()
code = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
os.chdir(sys.argv[2])
assert len(code) == 5, len(code)

with h5py.File("out/runs/run_1.h5") as file:
    friction = float(re.search(r"^\[ground.ground\]\nfriction_deg = ([0-9.e-]+)", file["config"][0].decode(),
                               re.MULTILINE)[1])
    origin = file.attrs["origin_m"]
    last = file["frames/position_m"][-1] + origin
    n_passages = len(file["passages/block"])
slope = math.radians(30)
acceleration = 9.81 * (math.sin(slope) - math.cos(slope) * math.tan(math.radians(friction)))
with open("profile.csv", "w", encoding="utf-8") as file:
    file.write("distance_m,speed_m_s\n")
    for distance in (5, 10, 20, 30):
        file.write(f"{distance},{math.sqrt(2 * acceleration * distance / math.cos(slope))}\n")

names = {}
for block in code:
    exec(compile(block, sys.argv[1], "exec"), names)

run, ensemble = names["run"], names["ensemble"]
assert np.abs(names["difference"]).max() < 0.1, names["difference"]
assert np.abs(run.frames.isel(time_s=-1).position_m.to_numpy() - last).max() == 0
assert np.abs(run["blocks"].rest_position_x_m - run.frames.position_m[0, :, 0].to_numpy()).max() < 0.2
assert len(run["passages"]) == n_passages and run["passages"].attrs["units"]["x_m"] == "m"
west, east = (float(f(run.frames.position_m.sel(axis="x"))) for f in (np.min, np.max))
assert run["passages"].x_m.between(west - 5, east + 5).all()
crossings = ensemble["crossings"]
assert abs(crossings.position_x_m - 500060).max() < 1e-6  # the line is there, in map coordinates
assert set(crossings.index.get_level_values("run")) <= set(ensemble.members.index)
assert run.frames.crs.startswith("PROJCRS") and run.crs == crossings.attrs["crs"]
assert (run.dataset("lines").points_m.sel(axis="x") == 500060).all()
