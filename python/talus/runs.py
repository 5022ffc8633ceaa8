"""Finished runs and sets of runs, as tables of pandas and arrays of xarray, in map coordinates.

Nothing is computed here: numbers are those of the files (docs/reference/formats.md), to which the
origin of the run is added where they are places.
"""
import json
import os
import re
import tomllib

import netCDF4
import numpy as np
import pandas as pd
import xarray as xr

FORMAT = "talus-run"
AXES = ["x", "y", "z"]
PLACE = re.compile(r"(?:^|.*_)([xyz])_m")  # x_m, position_x_m: a component of a place
PLACES = re.compile(r"(?:.*_)?(?:position|points|streamline)_m")  # all components
LOCAL = re.compile(r",? ?\blocal\b(?: [xyz]\b)?")  # in words about them
ROWS = ["row", "block", "line", "object", "forest"]  # dimensions of tables


class Run:
    """One run file. Groups are read when they are asked for."""

    def __init__(self, path):
        self.path = os.fspath(path)
        with netCDF4.Dataset(self.path) as file:
            self.attrs = {name: file.getncattr(name) for name in file.ncattrs()}
            if self.attrs.get("format") != FORMAT:
                raise ValueError(f"{self.path}: is of the format {self.attrs.get('format')}, expected {FORMAT}; "
                                 "give a run of talus-dda")
            if "Conventions" not in self.attrs:
                raise ValueError(f"{self.path}: names no dimensions, as runs of Talus {self.attrs['version']} do not; "
                                 "compute it again")
            self.tables = [name for name in file.groups if name != "frames"]
        self.crs = self.attrs["crs"]
        self.origin = np.asarray(self.attrs["origin_m"])

    def __repr__(self):
        return f"<talus.Run {self.attrs['run_id']} of {self.attrs['site']}: {', '.join(self.tables)}, frames>"

    def dataset(self, group):
        """A group of the file as a Dataset, places in map coordinates."""
        data = xr.load_dataset(self.path, group=group)
        for name, values in data.items():
            place = PLACE.fullmatch(name)
            if place:
                shift = self.origin[AXES.index(place[1])]
            elif PLACES.fullmatch(name) and values.ndim > 1:
                shift = self.origin[:values.shape[-1]]
            else:
                continue
            data[name] = values.copy(data=values.to_numpy() + shift)
            data[name].attrs["long_name"] = LOCAL.sub("", values.attrs["long_name"])
        labels = {"axis": AXES, "quaternion": list("wxyz")}
        data.attrs.pop("origin_m", None)
        data.attrs["crs"] = self.crs
        return data.assign_coords({name: words for name, words in labels.items() if data.sizes.get(name) == len(words)})

    @property
    def frames(self):
        """Places and motions of all blocks at equal intervals, by time and block."""
        return self.dataset("frames")

    @property
    def settings(self):
        """The effective settings by section and key, as the site file has them: settings["solver"]["duration_s"]."""
        with netCDF4.Dataset(self.path) as file:
            return tomllib.loads(file["config"][0])

    @property
    def cells(self):
        """Centres of the cells that passages are recorded on: `y_m` of rows from the north, `x_m` of columns."""
        with netCDF4.Dataset(self.path) as file:
            return self._cells(file["passages"].__dict__)

    def __getitem__(self, name):
        """A table as a DataFrame: one row a crossing, a passage, a block ... `attrs` has units, meanings, the CRS.

        Columns of the file with several numbers a row become one column each. Data without a column (corners of
        blocks, points of lines) is in dataset().
        """
        if name not in self.tables:
            raise KeyError(f"{self.path}: has no table {name}, only {', '.join(self.tables)}")
        data = self.dataset(name)
        row = next(dimension for dimension in ROWS if dimension in data.sizes)
        if name == "passages":
            cells = self._cells(data.attrs)
            north, west = np.divmod(data.cell.to_numpy(), data.attrs["n_cols"])
            words = {"units": "m", "long_name": "centre of the cell"}
            data = data.assign(x_m=(row, cells["x_m"][west], words), y_m=(row, cells["y_m"][north], words))
        columns, units, words = {}, {}, {}
        for key, values in data.items():
            if values.dims[0] != row:
                continue
            for column, numbers in self._columns(key, values.to_numpy()):
                columns[column] = numbers
                units[column] = values.attrs.get("units", "")
                words[column] = values.attrs["long_name"]
        frame = pd.DataFrame(columns, index=pd.RangeIndex(data.sizes[row], name=row))
        frame.attrs.update(units=units, long_name=words, crs=self.crs)
        return frame

    @staticmethod
    def _columns(key, values):
        """mass_kg as it is; rest_position_m as rest_position_x_m, _y_m, _z_m; drop_path_chord_m by its words."""
        if values.ndim == 1:
            return [(key, values)]
        stem, unit = re.fullmatch(r"(.*?)((?:_(?:m|s|rad|kg|m2))*)", key).groups()
        if len(stem.split("_")) == values.shape[1]:
            return [(word + unit, values[:, k]) for k, word in enumerate(stem.split("_"))]
        words = {2: "xy", 3: "xyz", 4: "wxyz"}.get(values.shape[1], range(values.shape[1]))
        return [(f"{stem}_{word}{unit}", values[:, k]) for k, word in enumerate(words)]

    @staticmethod
    def _cells(attrs):
        size, (left, top) = attrs["cell_size_m"], attrs["corner_map_m"]
        return {"y_m": top - (np.arange(attrs["n_rows"]) + 0.5) * size,
                "x_m": left + (np.arange(attrs["n_cols"]) + 0.5) * size}


class Ensemble:
    """Runs that belong together. `members` has the outcome of each; tables join those of the runs that count."""

    def __init__(self, folder):
        self.folder = os.fspath(folder)
        path = os.path.join(self.folder, "ensemble.json")
        if not os.path.exists(path):
            raise FileNotFoundError(f"{path}: is not there; talus-batch writes it, and every tool that is given "
                                    "the folder")
        with open(path, encoding="utf-8") as file:
            self.attrs = json.load(file)
        if self.attrs.get("format") != "talus-ensemble":
            raise ValueError(f"{path}: is of the format {self.attrs.get('format')}, expected talus-ensemble")
        self.members = pd.DataFrame(self.attrs.pop("members"))
        self.members.index.name = "run"

    def __repr__(self):
        return f"<talus.Ensemble {self.folder}: {len(self.members)} runs, {len(self)} done>"

    def __len__(self):
        return int((self.members["outcome"] == "done").sum())

    def runs(self):
        """The runs that are done, by their row in `members`."""
        for row, member in self.members[self.members["outcome"] == "done"].iterrows():
            yield row, Run(os.path.join(self.folder, member["file"]))

    def __getitem__(self, name):
        """A table of all runs that are done, by `run` (row of members), with `case` and `run_weight` in front."""
        tables = {row: run[name] for row, run in self.runs() if name in run.tables}
        if not tables:
            raise KeyError(f"{self.folder}: no run that is done has a table {name}")
        frame = pd.concat(tables, names=["run"])
        row = frame.index.get_level_values("run")
        frame.insert(0, "case", self.members["case"].reindex(row).to_numpy())
        frame.insert(1, "run_weight", self.members["weight"].reindex(row).to_numpy())
        frame.attrs = next(iter(tables.values())).attrs
        return frame


def open_run(path):
    """A run file of talus-dda. Raises ValueError for another file."""
    return Run(path)


def open_ensemble(folder):
    """The runs of a folder, as its ensemble.json lists them."""
    return Ensemble(folder)
