#!/usr/bin/env python3
"""Field tests: computed results beside observations, every case by one command.

- Tschamut 2014: 18 runs of blocks of 40 to 79 kg on a meadow.
- Authume quarry, path P1: 41 boulders of 0.2 to 1.8 t on a slope, two walls and a hard floor.
- Chant Sura: 11 single hits of blocks of 210 to 780 kg on a meadow.

Blocks of the observed size and mass start where the observed ones did, each alone, in random attitudes.
Terrain beyond the observed tracks is held level in the first row of a site: no node is lower than the
lowest deposit. The second row has the terrain as supplied. A hit is a block that meets a plane of the
observed slope with the observed velocity, and a spin forward; its speed is taken where it has left the
plane for at least 0.1 s.

Intervals are 95 %, of the observed runs and of the computed blocks of each drawn again (bootstrap). The
noise of the data is the area between halves of the observed runs drawn at random, its median and 95 %.
--set changes a section [ground.NAME] of the site files that have it, as in talus-dda.
"""
import csv

import h5py
import numpy as np
from osgeo import gdal

from study import Study

gdal.UseExceptions()
N_DRAWN = 500  # sets drawn again
N_HITS = 60  # blocks a hit
SITE = ('[site]\nname = "field"\n[material.rock]\ndensity_kg_m3 = {}\n[solver]\nduration_s = {}\n'
        'max_lost_share = 1\n[output]\npassages = false\nframes = {}\nframe_interval_s = {}\n')
GROUND = {"meadow": '[ground.meadow]\nsoil = "meadow"\n',
          "quarry": ('[terrain]\nground_raster = "{}"\n[ground.vegetated]\nsoil = "thin_soil"\nraster_values = [1]\n'
                     '[ground.hard]\nsoil = "rock"\nraster_values = [2]\n'
                     '[ground.rocky]\nsoil = "talus"\nraster_values = [3]\n[ground.beyond]\nsoil = "rock"\n')}


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def numbers(row, *names):
    return np.array([float(row[name]) for name in names])


def rocks(name, shape, volume, places, velocity, n, more=""):
    """Section of `n` blocks at each place."""
    return (f'[rockfall.{name}]\n{shape}volume_m3 = {volume:.6f}\nposition_m = {[list(p) for p in places]}\n'
            f'velocity_m_s = {list(velocity)}\nrocks = {n}\nseed = {int("".join(filter(str.isdigit, name)))}\n{more}')


class Tools:
    """The tools, run in the folder of a study; `more` words KEY=VALUE change sections [ground.*]."""

    def __init__(self, study, more=()):
        self.study, self.folder, self.more = study, study.out, more

    def run(self, tool, *words):
        self.study.run(tool, *words, "--no-db", "-q", "--overwrite", codes=(0, 3))  # 3: a limit of the run's health

    def terrain(self, name, z, transform, no_data=-9999):
        file = gdal.GetDriverByName("GTiff").Create(str(self.folder / f"{name}_dem.tif"), z.shape[1], z.shape[0], 1,
                                                    gdal.GDT_Float64)
        file.SetGeoTransform(transform)
        file.GetRasterBand(1).SetNoDataValue(no_data)
        file.GetRasterBand(1).WriteArray(z)
        file = None
        self.run("talus-trn", f"{name}_dem.tif", "-o", f"{name}.tif", "--crs", "none")

    def simulate(self, name, text, terrain):
        """The run of a site file; `name` is also that of its files."""
        (self.folder / f"{name}.toml").write_text(text)
        files = [f"{name}.toml", "--trn", f"{terrain}.tif"]
        self.run("talus-blocks", *files, "-o", f"{name}.blocks.h5")
        section = lambda value: "[" + value.partition("=")[0].rpartition(".")[0] + "]"
        more = [word for value in self.more if section(value) in text for word in ("--set", value)]
        self.run("talus-dda", *files, "--blocks", f"{name}.blocks.h5", "-o", f"{name}.h5", "--settle", *more)
        return h5py.File(self.folder / f"{name}.h5")


def direction_of(vectors):
    mean = vectors.mean(0)
    return mean / np.hypot(*mean)


def sides(vectors, along):
    """Distance in plan; distance and angle across the direction `along`."""
    across = vectors @ np.array([-along[1], along[0]])
    return {"length": np.hypot(*vectors.T), "across": across,
            "angle": np.degrees(np.arctan2(across, vectors @ along))}


def area(a, b):
    """Area between two distribution functions (first Wasserstein distance), unit of the values."""
    at = np.sort(np.concatenate([a, b]))
    share = lambda x: np.searchsorted(np.sort(x), at[:-1], "right") / len(x)
    return float(np.abs(share(a) - share(b)) @ np.diff(at))


def width(values):
    return float(np.subtract(*np.percentile(values, [90, 10])))


def with_interval(of, runs, draw):
    """`of` the runs, and its 95 % where runs and blocks are drawn again. runs: seen vector and vectors, a row each."""
    seen, blocks = (np.asarray(x) for x in runs)
    values = []
    for _ in range(N_DRAWN):
        chosen = draw.integers(len(seen), size=len(seen))
        again = draw.integers(blocks.shape[1], size=(len(seen), blocks.shape[1]))
        values.append(of(seen[chosen], np.take_along_axis(blocks[chosen], again, 1).ravel()))
    low, high = np.percentile(values, [2.5, 97.5])
    return tuple(f"{x:.1f}" for x in (of(seen, blocks.ravel()), low, high))


def noise(seen, draw):
    """Area between two halves of the runs drawn at random: median and 95 %."""
    halves = [draw.permutation(seen) for _ in range(N_DRAWN)]
    return np.percentile([area(h[::2], h[1::2]) for h in halves], [50, 2.5, 97.5])


class Slope:
    """A site: a terrain, releases with an observed displacement each, and the text of its site file."""

    def __init__(self, name, tools, terrain, starts, ends, text):
        self.name, self.tools, self.text = name, tools, text
        raster = gdal.Open(str(terrain))
        z, transform = raster.ReadAsArray().astype(float), raster.GetGeoTransform()
        column = ((ends[:, 0] - transform[0]) / transform[1]).astype(int)
        row = ((ends[:, 1] - transform[3]) / transform[5]).astype(int)
        self.lowest = z[row, column].min()
        self.starts, self.seen = starts, ends - starts
        self.along = direction_of(self.seen)
        tools.terrain(f"{name}_supplied", z, transform)
        tools.terrain(f"{name}_level", np.where(z > -9999, np.maximum(z, self.lowest), z), transform)

    def simulate(self, terrain):
        """Displacement of each run's blocks in plan (runs x blocks x 2), and whether each left the terrain."""
        with self.tools.simulate(f"{self.name}_{terrain}", self.text, f"{self.name}_{terrain}") as run:
            frames = run["frames"]
            ends = frames["position_m"][-1] + frames.attrs["origin_m"]
            left = run["blocks/phase"][:] == 3
        ends = ends.reshape(len(self.starts), -1, 3)[:, :, :2]
        return ends - self.starts[:, None], left

    def figures(self, terrain):
        """For fits: the fitted part of the rows."""
        moved, _ = self.simulate(terrain)
        seen, made = sides(self.seen, self.along), sides(moved.reshape(-1, 2), self.along)
        return {"mean": made["length"].mean(), "area": area(seen["length"], made["length"]),
                "width": width(made["length"]), "across": made["across"].std() / seen["across"].std()}

    def add_rows(self):
        draw = np.random.default_rng(1)
        seen = sides(self.seen, self.along)
        length, farthest = seen["length"], seen["length"].max()
        again = [draw.integers(len(length), size=len(length)) for _ in range(N_DRAWN)]
        interval = lambda of: (f"{x:.1f}" for x in (of(slice(None)), *np.percentile([of(k) for k in again], [2.5, 97.5])))
        tens = lambda values: {f"p{p} [m]": f"{x:.0f}" for p, x in zip((10, 50, 90), np.percentile(values, [10, 50, 90]))}
        add = lambda row, quantities: self.tools.study.row("slopes", f"{self.name}, {row}", quantities)
        add("observed", {"mean run-out [m]": tuple(interval(lambda k: length[k].mean())), **tens(length),
                         "p90 - p10 [m]": tuple(interval(lambda k: width(length[k]))),
                         "area [m]": tuple(f"{x:.1f}" for x in noise(length, draw)),
                         "across [m]": tuple(interval(lambda k: seen["across"][k].std()))})
        for terrain in ("level", "supplied"):
            moved, left = self.simulate(terrain)
            made = sides(moved.reshape(-1, 2), self.along)
            runs = length, made["length"].reshape(moved.shape[:2])
            across = seen["across"], made["across"].reshape(moved.shape[:2])
            add(terrain, {"mean run-out [m]": with_interval(lambda _, x: x.mean(), runs, draw), **tens(made["length"]),
                          "p90 - p10 [m]": with_interval(lambda _, x: width(x), runs, draw),
                          "area [m]": with_interval(area, runs, draw),
                          "across [m]": with_interval(lambda _, x: x.std(), across, draw),
                          "beyond the farthest [%]": f"{100 * (made['length'] > farthest).mean():.0f}",
                          "left [%]": f"{100 * left.mean():.0f}"})


def tschamut(tools, data, n=60):
    sizes = {r["block_id"]: r for r in rows_of(data / "block_metadata.csv")}
    text, ends = SITE.format(2650, 60, "false", 1) + GROUND["meadow"], {}
    deposits = {r["trajectory_id"]: numbers(r, "x_m", "y_m") for r in rows_of(data / "observed_deposition.csv")}
    releases = rows_of(data / "release_points.csv")
    for r in releases:
        size = numbers(sizes[r["block_id"]], "size_x_m", "size_y_m", "size_z_m")
        text += rocks(r["trajectory_id"], f'shape = "rock"\nsize_m = {list(size)}\n', float(r["mass_kg"]) / 2650,
                      [numbers(r, "x_m", "y_m", "z_m")], numbers(r, "vx_mps", "vy_mps", "vz_mps"), n)
    return Slope("tschamut", tools, data / "terrain.asc", np.array([numbers(r, "x_m", "y_m") for r in releases]),
                 np.array([deposits[r["trajectory_id"]] for r in releases]), text)


def authume(tools, data, n=6):
    places = [numbers(r, "x_m", "y_m", "z_m") for r in rows_of(data / "drops.csv")]
    boulders = rows_of(data / "boulders.csv")
    text = SITE.format(2600, 60, "false", 1) + GROUND["quarry"].format(data / "zones.tif")
    for r in boulders:
        text += rocks("b" + r["block"], f'shape = "rock"\nsize_m = {list(numbers(r, "l1_m", "l2_m", "l3_m"))}\n',
                      float(r["mass_kg"]) / 2600, places, (0, 0, 0), n)
    ends = np.array([numbers(r, "end_x_m", "end_y_m") for r in boulders])
    return Slope("authume_P1", tools, data / "terrain.tif", np.tile(np.mean(places, 0)[:2], (len(ends), 1)), ends, text)


class Hits:
    """Single hits on planes."""
    INTERVAL = 0.01  # s
    NEAR = 0.05  # m/s that gravity leaves unexplained in an interval of contact
    FLIGHT = 10  # intervals

    def __init__(self, tools, data):
        self.tools, self.hits = tools, rows_of(data / "chant_sura_hits.csv")
        for slope in {hit["local_slope_deg"] for hit in self.hits}:
            x = np.arange(-29.5, 30)
            z = np.tile(-np.tan(np.radians(float(slope))) * x, (60, 1))
            tools.terrain(f"plane_{slope}", z, (-30, 1, 0, 30, 0, -1))

    def simulate(self, k):
        """Share of the speed kept, normal and tangential speed after the hit; of the blocks that leave the plane."""
        hit = self.hits[k]
        slope = np.radians(float(hit["local_slope_deg"]))
        normal, down = np.array([np.sin(slope), 0, np.cos(slope)]), np.array([np.cos(slope), 0, -np.sin(slope)])
        velocity = -abs(float(hit["vn_in_m_s"])) * normal + float(hit["vt_in_m_s"]) * down
        text = SITE.format(2650, 1, "true", self.INTERVAL) + GROUND["meadow"]
        text += rocks(f"hit{k}", f'shape = "eota{hit["shape"].split()[-1]}"\n', float(hit["mass_kg"]) / 2650, [(0, 0)],
                      velocity, N_HITS, "height_above_ground_m = 0.05\n"
                      f'spin_rad_s = [0, {hit["spin_in_rad_s"]}, 0]\n')
        with self.tools.simulate(f"hit{k}", text, f"plane_{hit['local_slope_deg']}") as run:
            v = run["frames/velocity_m_s"][:].astype(float)
        free = np.linalg.norm(np.diff(v, axis=0) - np.array([0, 0, -9.81]) * self.INTERVAL, axis=2) < self.NEAR
        kept = []
        for b in range(v.shape[1]):
            first = np.argmax(~free[:, b])
            leaves = next((i for i in range(first + 1, len(free) - self.FLIGHT)
                           if free[i:i + self.FLIGHT, b].all()), None)
            if leaves is not None:
                after = v[leaves, b]
                kept.append((np.linalg.norm(after) / np.linalg.norm(v[first, b]), after @ normal, after @ down))
        return np.array(kept)

    def add_rows(self):
        means = np.array([self.simulate(k).mean(0) for k in range(len(self.hits))])
        seen = np.array([float(h["speed_kept"]) for h in self.hits])
        approach = np.array([abs(float(h["vn_in_m_s"])) for h in self.hits])
        along = np.array([float(h["vt_in_m_s"]) for h in self.hits])
        speed = np.array([float(h["speed_in_m_s"]) for h in self.hits])
        after = np.array([numbers(hit, "vn_out_m_s", "vt_out_m_s") for hit in self.hits])
        for name, kept, of in (("observed", seen, after), ("computed", means[:, 0], means[:, 1:])):
            error = 2 * kept.std(ddof=1) / len(kept) ** 0.5
            self.tools.study.row("hits", name, {
                "share of speed kept": tuple(f"{kept.mean() + x:.2f}" for x in (0, -error, error)),
                "of the normal part": f"{(of[:, 0] / approach).mean():.2f}", "along": f"{(of[:, 1] / along).mean():.2f}",
                "share kept per m/s of speed": f"{np.polyfit(speed, kept, 1)[0]:+.2f}",
                "normal part per m/s of approach": f"{np.polyfit(approach, of[:, 0] / approach, 1)[0]:+.2f}"})


STUDY = Study(__file__, __doc__)
STUDY.words.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")


@STUDY.part("tschamut", 12)
def of_tschamut(study):
    study.need_data("experiments/tschamut2014")
    tschamut(Tools(study, study.options.set), study.data / "experiments/tschamut2014").add_rows()


@STUDY.part("authume_P1", 12)
def of_authume(study):
    study.need_data("experiments/authume_P1")
    authume(Tools(study, study.options.set), study.data / "experiments/authume_P1").add_rows()


@STUDY.part("hits", 4)
def of_hits(study):
    Hits(Tools(study, study.options.set), study.data / "experiments").add_rows()


if __name__ == "__main__":
    STUDY.main()
