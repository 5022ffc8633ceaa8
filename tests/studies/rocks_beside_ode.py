#!/usr/bin/env python3
"""The same rocks through Talus and through ODE, a public engine of rigid bodies: energies and reach side by side.

Two scenes: a slope of 38 degrees with a bench that runs out on a flat, and the crater wall of
sample_sites/crater_rocks. Rocks (eota111, eota221) fall 1.5 m from rest on ground with a constant COR and friction
alone, and do not meet. ODE gets shapes, masses, inertias, places and attitudes from the run file of Talus, and the
triangles of its TRN. Both are evaluated by the same lines, from frames of 0.05 s.

- the table of a scene: each engine at two time steps, with half of the 95 % intervals (bootstrap over the rocks), and
  ODE with a cone of friction; a star where a column differs from Talus at 1 ms by more than chance;
- single bounces: impulses of hits at one corner beside their closed form (Newton's restitution, Coulomb's friction).

Needs c++, Eigen and libode-dev.
"""
import math
import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from osgeo import gdal

from study import SOURCE, Study, skip

gdal.UseExceptions()
FRICTION_DEG, COR, GRAVITY, FRAME_S = 32, 0.35, 9.80665, 0.05
AT_REST_M_S = 0.1
N_DRAWN = 1000  # sets of rocks drawn again
RELEASE = 'height_above_ground_m = 1.5\nmaterial = "rock"'


@dataclass
class Scene:
    """A terrain, its rocks, and lines across the direction of motion."""
    name: str
    release: str         # keys of [rockfall.*]
    places: int          # that rocks are released at; 0: all over the polygon, two of a shape a place
    axis: int            # 0: rocks run to the east, 1: to the north
    start: float         # map coordinate along the axis that lines are measured from
    lines: tuple         # distances from it [m]
    duration_s: float


SLOPE = Scene("slope", "position_m = [[10, 200]]\n" + RELEASE, 1, 0, 10, (50, 58), 60)
CRATER = Scene("crater", "polygon = [[1757190, 5917210], [1757270, 5917210], [1757270, 5917240], [1757190, 5917240]]\n"
               "min_slope_deg = 32\n" + RELEASE, 0, 1, 5917210, (86,), 60)


def run(*words, codes=(0,)):
    """Output of a command, and its CPU seconds."""
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    before = used()
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout, used() - before


# --- terrain, rocks, runs ------------------------------------------------------------------------

def make_terrain(tools, scene, out):
    """The TRN: 38 degrees to 60 m, a bench of 10 m, 38 degrees to 110 m, then flat; or the crater's."""
    trn = out / "terrain/trn.tif"
    trn.parent.mkdir(exist_ok=True)
    if trn.exists():
        return trn
    if scene is CRATER:
        run("make", "-C", SOURCE / "sample_sites/crater_rocks", f"BIN={tools}/", f"OUT={trn.parent}", "terrain")
        return trn
    x = np.arange(81) * 5.0
    down = np.interp(x, [0, 60, 70, 110, 400], np.array([0, 60, 60, 100, 100]))
    z = 100 - math.tan(math.radians(38)) * down
    rows = "\n".join(" ".join(f"{v:.9f}" for v in z) for _ in range(81))
    (out / "dem.asc").write_text(f"ncols 81\nnrows 81\nxllcorner -2.5\nyllcorner -2.5\ncellsize 5\n{rows}\n")
    run(tools / "talus-trn", out / "dem.asc", "-o", trn, "--crs", "none", "--no-db", "-q")
    return trn


class Ground:
    """Nodes of the TRN, local coordinates."""

    def __init__(self, path, origin):
        data = gdal.Open(str(path))
        band = data.GetRasterBand(1)
        west, self.cell, _, north, _, _ = data.GetGeoTransform()
        self.west, self.north = west + self.cell / 2 - origin[0], north - self.cell / 2 - origin[1]
        self.z = band.ReadAsArray().astype(float)
        self.z[self.z == band.GetNoDataValue()] = np.nan

    def at(self, x, y):
        """Height of the triangles, and their unit normals."""
        column, row = (x - self.west) / self.cell, (self.north - y) / self.cell
        j, i = (np.clip(np.floor(v).astype(int), 0, n - 2) for v, n in
                ((column, self.z.shape[1]), (row, self.z.shape[0])))
        right, below = column - j, row - i
        z00, z01, z10, z11 = self.z[i, j], self.z[i, j + 1], self.z[i + 1, j], self.z[i + 1, j + 1]
        is_low = below > right
        east = np.where(is_low, z11 - z10, z01 - z00)
        south = np.where(is_low, z10 - z00, z11 - z01)
        normal = np.stack([-east, south, np.full_like(east, self.cell)], -1)
        return z00 + right * east + below * south, normal / np.linalg.norm(normal, axis=-1, keepdims=True)


@dataclass
class Rocks:
    mass: np.ndarray
    inertia: np.ndarray
    vertices: list
    faces: list


@dataclass
class Motion:
    """Frames of a run: (frames, rocks, ...); CPU seconds of the engine."""
    position: np.ndarray
    attitude: np.ndarray
    velocity: np.ndarray
    spin: np.ndarray
    cpu_s: float


class Runs:
    """One scene: its files, its rocks, and runs of both engines."""

    def __init__(self, tools, peer, scene, out, n_rocks):
        self.tools, self.peer, self.scene, self.out = tools, peer, scene, out
        out.mkdir(parents=True, exist_ok=True)
        self.trn = make_terrain(tools, scene, out)
        site = out / "site.toml"
        if not (out / "blocks.h5").exists():
            each = n_rocks // 2 if scene.places else 2
            spacing = "" if scene.places else f"release_spacing_m = {math.sqrt(8400 / n_rocks):.2f}\n"
            site.write_text('[site]\nname = "rocks"\n' + "".join(
                f'[rockfall.{shape}]\nshape = "{shape}"\nsize_m = [1]\nrocks = {each}\nseed = {seed}\n'
                f'{spacing}{scene.release}\n' for seed, shape in ((1, "eota111"), (2, "eota221"))) +
                f'[material.rock]\ndensity_kg_m3 = 2600\n[ground.firm]\nfriction_deg = {FRICTION_DEG}\ncor = {COR}\n'
                f'[output]\npassages = false\n')
            run(tools / "talus-blocks", site, "--trn", self.trn, "-o", out / "blocks.h5", "--no-db", "-q")
        self.talus(duration_s=1)  # gives the rocks
        with h5py.File(self.talus_file(duration_s=1)) as file:
            blocks = {name: file["blocks"][name][...] for name in file["blocks"]}
            self.origin = file.attrs["origin_m"]
        begin, corners, faces = blocks["vertex_begin"], blocks["face_begin"], blocks["block_face_begin"]
        self.rocks = Rocks(blocks["mass_kg"], blocks["inertia_kg_m2"],
                           [blocks["vertices_m"][low:high] for low, high in zip(begin, begin[1:])],
                           [[blocks["face_vertices"][corners[f]:corners[f + 1]] - begin[k]
                             for f in range(*faces[k:k + 2])] for k in range(len(begin) - 1)])
        self.ground = Ground(self.trn, self.origin)
        self.write_scene(blocks)

    def write_scene(self, blocks):
        numbers = lambda values: " ".join(f"{v:.17g}" for v in np.ravel(values))
        z = self.ground.z
        lines = [f"{z.shape[0]} {z.shape[1]} {numbers([self.ground.cell, self.ground.west, self.ground.north])}",
                 *(numbers(row) for row in z), str(len(self.rocks.mass))]
        for k, mass in enumerate(self.rocks.mass):
            lines += [numbers([mass, *self.rocks.inertia[k], *blocks["rest_position_m"][k],
                               *blocks["rest_attitude"][k]]),
                      f"{len(self.rocks.vertices[k])} {numbers(self.rocks.vertices[k])}", str(len(self.rocks.faces[k])),
                      *(f"{len(face)} {' '.join(map(str, face))}" for face in self.rocks.faces[k])]
        (self.out / "scene.txt").write_text("\n".join(lines) + "\n")

    def talus_file(self, step_s=1e-3, frame_s=FRAME_S, duration_s=None, friction_deg=FRICTION_DEG, cor=COR):
        """The run file with these settings, computed if it is not there."""
        keys = {"solver.time_step_s": step_s, "output.frame_interval_s": frame_s,
                "solver.duration_s": duration_s or self.scene.duration_s, "ground.firm.friction_deg": friction_deg,
                "ground.firm.cor": cor}
        file = self.out / ("talus_" + "_".join(f"{value:g}" for value in keys.values()) + ".h5")
        if not (note := file.with_suffix(".cpu")).exists():
            sets = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
            _, cpu_s = run(self.tools / "talus-dda", self.out / "site.toml", "--trn", self.trn, "--blocks",
                           self.out / "blocks.h5", "-o", file, "--threads", 1, "--no-db", "-q", "--overwrite", *sets,
                           codes=(0, 3))
            note.write_text(str(cpu_s))
        return file

    def talus(self, *settings, **more):
        file = self.talus_file(*settings, **more)
        with h5py.File(file) as kept:
            return Motion(*(kept["frames"][name][...].astype(float) for name in
                            ("position_m", "attitude", "velocity_m_s", "spin_rad_s")),
                          float(file.with_suffix(".cpu").read_text()))

    def ode(self, step_s=1e-3, frame_s=FRAME_S, duration_s=None, friction_deg=FRICTION_DEG, cor=COR, **more):
        settings = {"step_s": step_s, "frame_s": frame_s, "duration_s": duration_s or self.scene.duration_s,
                    "gravity_m_s2": GRAVITY, "friction": math.tan(math.radians(friction_deg)), "restitution": cor,
                    "bounce_m_s": min(0.1, 2 * GRAVITY * step_s), **more}
        file = self.out / ("ode_" + "_".join(f"{value:g}" for value in settings.values()) + "".join(more) + ".bin")
        if not (note := file.with_suffix(".cpu")).exists():
            printed, _ = run(self.peer, self.out / "scene.txt", file, *(f"{k}={v:.12g}" for k, v in settings.items()))
            note.write_text(printed)
        values = np.fromfile(file).reshape(len(self.rocks.mass), -1, 13).swapaxes(0, 1)
        return Motion(values[..., :3], values[..., 3:7], values[..., 7:10], values[..., 10:], float(note.read_text()))


# --- comparison ----------------------------------------------------------------------------------

def rotations(q):
    """Rotation matrices of attitudes (..., w x y z)."""
    w, x, y, z = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
            2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
    return np.stack(rows, -1).reshape(*w.shape, 3, 3)


def kinetic_per_mass(study, motion):
    """(frames, rocks): translation and rotation [J/kg]."""
    spin = np.einsum("fkji,fkj->fki", rotations(motion.attitude), motion.spin)
    turning = (spin ** 2 * study.rocks.inertia).sum(-1) / study.rocks.mass
    return ((motion.velocity ** 2).sum(-1) + turning) / 2


def evaluate(study, motion):
    """Quantities a rock; NaN where a rock does not have it (did not cross, left the terrain)."""
    scene, x = study.scene, motion.position
    kinetic = kinetic_per_mass(study, motion)
    total = kinetic + GRAVITY * x[..., 2]
    path = x[-1] - x[0]
    plan = np.hypot(path[:, 0], path[:, 1])
    moves = np.linalg.norm(motion.velocity, axis=-1) > AT_REST_M_S
    rest = (len(x) - np.argmax(moves[::-1], axis=0)) * FRAME_S
    left = moves[-1]
    out = {"displacement": plan, "reach angle": np.degrees(np.arctan2(-path[:, 2], plan)),
           "time to rest": np.where(left, np.nan, rest), "still moving or left": left.astype(float),
           "largest energy": kinetic.max(0),
           "energy gained": (total - np.minimum.accumulate(total, 0)).max(0) / (total[0] - total[-1])}
    along = x[..., scene.axis] - (scene.start - study.origin[scene.axis])
    rock = np.arange(x.shape[1])
    for line in scene.lines:
        beyond = along >= line
        after = np.argmax(beyond, axis=0)
        passed = beyond[after, rock] & (after > 0)
        before = np.maximum(after - 1, 0)
        here, there = along[before, rock], along[after, rock]
        share = np.where(passed, (line - here) / np.where(passed, there - here, 1), 0)
        mix = lambda v: (1 - share) * v[before, rock] + share * v[after, rock]
        place = [mix(x[..., k]) for k in range(3)]
        height = place[2] + GRAVITY * (share * (1 - share)) * FRAME_S ** 2 / 2 - study.ground.at(place[0], place[1])[0]
        out[f"passed {line} m"] = passed.astype(float)
        out[f"energy at {line} m"] = np.where(passed, mix(kinetic), np.nan)
        out[f"height at {line} m"] = np.where(passed, height, np.nan)
    return out


def drawn(values, percentile, picks):
    """The statistic of the rocks, and of each set of rocks drawn again."""
    if percentile is None:
        return np.nanmean(values), np.nanmean(values[picks], axis=-1)
    return np.nanpercentile(values, percentile), np.nanpercentile(values[picks], percentile, axis=-1)


def half_interval(sets):
    return np.ptp(np.nanpercentile(sets, [2.5, 97.5])) / 2


def rows_of(scene):
    """(title, quantity, percentile; None: mean, digits) of a table."""
    rows = [("displacement, p50 [m]", "displacement", 50, 0), ("displacement, p90 [m]", "displacement", 90, 0),
            ("angle of reach, p50 [degrees]", "reach angle", 50, 1), ("time to rest, p50 [s]", "time to rest", 50, 1)]
    for line in scene.lines:
        rows += [(f"share past {line} m", f"passed {line} m", None, 3),
                 (f"energy at {line} m, p50 [J/kg]", f"energy at {line} m", 50, 0),
                 (f"energy at {line} m, p95 [J/kg]", f"energy at {line} m", 95, 0),
                 (f"height at {line} m, p50 [m]", f"height at {line} m", 50, 1)]
    return rows


def add_scene(report, study):
    """One column a run; a star where it differs from Talus at 1 ms by more than chance."""
    runs = {"Talus, 1 ms": study.talus(), "Talus, 5 ms": study.talus(step_s=5e-3), "ODE, 1 ms": study.ode(),
            "ODE, 5 ms": study.ode(step_s=5e-3), "ODE in a cone, 1 ms": study.ode(cone=1)}
    results = {name: evaluate(study, motion) for name, motion in runs.items()}
    rng = np.random.default_rng(1)
    n = len(study.rocks.mass)
    picks = {name: rng.integers(0, n, (N_DRAWN, n)) for name in runs}
    for title, quantity, percentile, digits in rows_of(study.scene):
        cells, reference = {}, None
        for name, result in results.items():
            if np.isfinite(result[quantity]).sum() < 20:
                continue
            value, sets = drawn(result[quantity], percentile, picks[name])
            reference = sets if reference is None else reference
            low, high = np.nanpercentile(sets - reference, [2.5, 97.5])
            cells[name] = f"{value:.{digits}f} ± {half_interval(sets):.{digits}f}{'' if low <= 0 <= high else ' *'}"
        report.row(study.scene.name, title, cells)
    report.row(study.scene.name, "CPU s", {name: f"{motion.cpu_s:.1f}" for name, motion in runs.items()})


# --- single bounces ------------------------------------------------------------------------------

def hit_at_corner(mass, inertia, arm, normal, before, free, friction, cor):
    """Impulse of a hit at one corner, and whether it sticks: Newton's restitution, Coulomb's friction at the end.

    before, free: velocity of the corner that approaches, and that it would have without the hit.
    inertia: about the axes of the ground (3 x 3). The end velocity is free + W P.
    """
    cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
    W = np.eye(3) / mass - cross @ np.linalg.inv(inertia) @ cross
    target = -cor * normal @ before
    stuck = np.linalg.solve(W, target * normal - free)
    pressed = normal @ stuck
    if np.linalg.norm(stuck - pressed * normal) <= friction * pressed:
        return stuck, W, True
    first = np.cross(normal, [1, 0, 0])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)

    def sliding(angles):
        """Part of the end slip across the assumed direction, and along it; the impulse."""
        sine, cosine = np.sin(angles)[..., None], np.cos(angles)[..., None]
        slip, across = cosine * first + sine * second, cosine * second - sine * first
        ray = normal - friction * slip
        impulse = (target - normal @ free) / (ray @ (W @ normal))[..., None] * ray
        end = free + impulse @ W
        return (across * end).sum(-1), (slip * end).sum(-1), impulse

    angles = np.linspace(0, 2 * math.pi, 181)
    errors, along, _ = sliding(angles)
    for k in np.flatnonzero((errors[1:] * errors[:-1] <= 0) & (along[1:] > 0)):
        low, high = angles[k], angles[k + 1]
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (middle, high) if sliding(middle)[0] * errors[k] > 0 else (low, middle)
        _, forwards, impulse = sliding(low)
        if forwards > 0 and normal @ impulse > 0:
            return impulse, W, False
    return None, W, False


def turned(R, spin, t):
    angle = np.linalg.norm(spin) * t
    if angle == 0:
        return R
    axis = spin / np.linalg.norm(spin)
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return (np.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K) @ R


def bounces(study, motion, step_s, is_ode):
    """Rows of hits at one corner between free flights: error of the impulse, sticks, share of the energy lost, and
    that in closed form."""
    rocks, g = study.rocks, np.array([0, 0, -GRAVITY])
    change = motion.velocity[1:] - motion.velocity[:-1] - g * step_s
    size = np.linalg.norm(change, axis=-1)
    free = size < 1e-4
    hits = (size[1:-1] > 0.1) & free[:-2] & free[2:]
    attitudes = rotations(motion.attitude)
    rows = []
    for frame, k in np.argwhere(hits):
        frame += 1
        R, x, v = attitudes[frame, k], motion.position[frame, k], motion.velocity[frame, k]
        w = motion.spin[frame, k]
        momentum = R @ (rocks.inertia[k] * (R.T @ w))

        def pose(t):
            """Attitude and corners after the time; the spin in the middle of it turns the rock."""
            half = turned(R, w, t / 2)
            end = turned(R, half @ ((half.T @ momentum) / rocks.inertia[k]), t)
            arms = rocks.vertices[k] @ end.T
            place = arms + x + v * t + g * t * t / 2
            z, normal = study.ground.at(place[:, 0], place[:, 1])
            return end, arms, (place[:, 2] - z) * normal[:, 2], normal

        time = 0.0
        if not is_ode:  # it meets the corner at the time of touch, ODE at the begin of the step
            low, high = 0.0, step_s
            for _ in range(40):
                time = (low + high) / 2
                low, high = (time, high) if pose(time)[2].min() > 0 else (low, time)
        end, arms, gaps, normals = pose(time)
        order = np.argsort(gaps)
        if gaps[order[1]] < 2e-3 or abs(gaps[order[0]]) > 0.05:
            continue
        arm, normal = arms[order[0]], normals[order[0]]
        inertia = end @ np.diag(rocks.inertia[k]) @ end.T
        spin = np.linalg.solve(inertia, momentum)
        before = v + g * time + np.cross(spin, arm)
        if -normal @ before < 0.1:
            continue
        impulse, W, sticks = hit_at_corner(rocks.mass[k], inertia, arm, normal, before,
                                           before + (g * step_s if is_ode else 0),
                                           math.tan(math.radians(FRICTION_DEG)), COR)
        if impulse is None:
            continue
        found = rocks.mass[k] * change[frame, k]
        energy = (rocks.mass[k] * (v + g * time) @ (v + g * time) + spin @ momentum) / 2
        lost = lambda p: -(p @ before + p @ W @ p / 2) / energy
        rows.append((np.linalg.norm(found - impulse) / np.linalg.norm(impulse), sticks, lost(found), lost(impulse)))
    return np.array(rows)


def add_bounces(report, study):
    for name, motion, step_s in (("Talus, 1 ms", study.talus(1e-3, 1e-3, 2), 1e-3),
                                 ("ODE, 1 ms", study.ode(1e-3, 1e-3, 2), 1e-3),
                                 ("ODE in a cone, 1 ms", study.ode(1e-3, 1e-3, 2, cone=1), 1e-3)):
        rows = bounces(study, motion, step_s, name.startswith("ODE"))
        for kind, sticks in (("sticks", 1), ("slides", 0)):
            error, _, lost, expected = rows[rows[:, 1] == sticks].T
            report.row("bounces", f"{name}, {kind}", {
                "hits": len(error), "error of the impulse, p50": f"{np.median(error):.1e}",
                "p95": f"{np.percentile(error, 95):.1e}", "energy lost [%]": f"{100 * lost.mean():.2f}",
                "in closed form [%]": f"{100 * expected.mean():.2f}"})


STUDY = Study(__file__, __doc__)
STUDY.words.add_argument("--rocks", type=int, default=500)


def runs_of(report, scene):
    """Runs of a scene, with ODE's program."""
    peer = report.out / "rocks_beside_ode"
    built = subprocess.run(["c++", "-O2", "-std=c++20", "-I/usr/include/eigen3",
                            str(Path(__file__).with_suffix(".cpp")), "-o", str(peer), "-lode"],
                           capture_output=True, text=True, check=False)
    if built.returncode != 0:
        skip(f"no ODE to build with (libode-dev, libeigen3-dev)\n{built.stderr[:300]}")
    return Runs(report.bin, peer, scene, report.out / scene.name, report.options.rocks)


@STUDY.part("slope", 200)
def slope(report):
    add_scene(report, runs_of(report, SLOPE))


@STUDY.part("crater", 200)
def crater(report):
    add_scene(report, runs_of(report, CRATER))


@STUDY.part("bounces", 60)
def of_bounces(report):
    add_bounces(report, runs_of(report, SLOPE))


if __name__ == "__main__":
    STUDY.main()
