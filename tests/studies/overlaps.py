#!/usr/bin/python3
"""Overlaps of all bodies of a run, recomputed by brute force and held against its health.

overlaps.py RUN.h5 --blocks BLOCKS.h5 --trn BED.tif [--every N] [--from T] [--to T] [--sample-m S]
            [--floor SHARE] [--json]

Nothing of the engine is used but the files. In every frame that is looked at:
- two blocks: all pairs of their convex parts by separating axes, faces and all products of edges.
  Of bodies of several parts the overlap is the least path, along any of those axes, that takes one
  out of all near parts of the other: out of one part may be into the next. Health takes the least
  displacement in any direction, which may be less.
- a block and the bed: the distance from the bed of its vertices below it, and the distance from the
  block's surface of points of the bed inside of it: nodes, and points SAMPLE_M apart between them.
Overlaps below FLOOR of the thinner block's thickness along a face are not looked into further.
Fences and fixed slopes of blocks are not looked at: rows that name one are listed, not judged.

Frames should be at every step ([output] frame_interval_s = the step). Ends with 1 where health
and brute force differ: a block that one of them calls deep and the other does not, its partner,
its depth by more than 2 % and the distance of samples, its time, its steps by more than 5 %, or a
step in which bodies that move are in farther than the largest penetration recorded, or less than
that by more than a twentieth of the largest thickness (up to there a contact speaks for itself).
Needs numpy, h5py and GDAL's Python module.
"""
import argparse
import itertools
import json
import sys

import h5py
import numpy as np
from osgeo import gdal

DEEP = 0.1  # of the thickness
SUSPECT = 0.05  # of the thickness: below that health takes a contact's own word
LEFT_TERRAIN, UNBORN = 3, 5  # phases at the end


class Part:
    """A convex part of a block, in the block's axes."""

    def __init__(self, vertices, faces):
        self.v = vertices
        self.loops = [vertices[face] for face in faces]
        centre = vertices.mean(0)
        self.n = np.array([newell(loop) for loop in self.loops])
        self.off = np.array([(loop @ n).mean() for loop, n in zip(self.loops, self.n)])
        assert ((self.n @ centre) < self.off).all(), "a face looks inward"
        directions = []
        for loop in self.loops:
            for a, b in zip(loop, np.roll(loop, -1, 0)):
                e = (b - a) / np.linalg.norm(b - a)
                if not any(abs(e @ d) > 1 - 1e-12 for d in directions):
                    directions.append(e)
        self.e = np.array(directions)
        self.bare = np.ones(len(faces), bool)

    def holds(self, x, within=0.0):
        return (self.n @ x <= self.off + within).all()


def newell(loop):
    n = np.cross(loop - loop[0], np.roll(loop, -1, 0) - loop[0]).sum(0)
    return n / np.linalg.norm(n)


def mark_covered(parts, size):
    """A face is bare where any of some of its points looks out of the body."""
    for p in parts:
        for f, loop in enumerate(p.loops):
            centre = loop.mean(0)
            points = [centre] + [centre + 0.9 * (x - centre) for x in loop]
            outside = [x + 1e-5 * size * p.n[f] for x in points]
            p.bare[f] = any(not any(q is not p and q.holds(x) for q in parts) for x in outside)


def thickness_of(parts, vertices, size):
    """The smallest extent of the body along a normal of its faces."""
    least = np.inf
    for p in parts:
        for n, off in zip(p.n, p.off):
            along = vertices @ n
            least = min(least, max(along.max(), off) - along.min())
    return least


def rotation(q):
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def read_bodies(run, blocks):
    """The convex parts of every block in its body axes, and its thickness."""
    shift = blocks.attrs["origin_m"] - run.attrs["origin_m"]
    vertices = blocks["vertices"][:] + shift
    face_vertices, face_begin = blocks["part_face_vertices"][:], blocks["part_face_begin"][:]
    part_begin, convex = blocks["part_begin"][:], blocks["convex_part_begin"][:]
    rest, turn = run["blocks/rest_position_m"][:], run["blocks/rest_attitude"][:]
    bodies, thickness = [], []
    for b in range(len(rest)):
        parts = []
        for p in range(convex[b], convex[b + 1]):
            loops = [face_vertices[face_begin[f]:face_begin[f + 1]]
                     for f in range(part_begin[p], part_begin[p + 1])]
            used = sorted(set(itertools.chain.from_iterable(loops)))
            local = {v: i for i, v in enumerate(used)}
            body_axes = (vertices[used] - rest[b]) @ rotation(turn[b])
            parts.append(Part(body_axes, [[local[v] for v in loop] for loop in loops]))
        every = np.concatenate([p.v for p in parts])
        size = np.linalg.norm(every, axis=1).max()
        mark_covered(parts, size)
        bodies.append(parts)
        thickness.append(thickness_of(parts, every, size))
    return bodies, np.array(thickness)


class Placed:
    """A part where its block is in a frame."""

    def __init__(self, part, position, turn):
        self.part = part
        self.v = part.v @ turn.T + position
        self.n = part.n @ turn.T
        self.off = part.off + self.n @ position
        self.low, self.high = self.v.min(0), self.v.max(0)
        self.turn, self.position = turn, position

    @property
    def e(self):
        return self.part.e @ self.turn.T


def face_overlap(a, b):
    """Upper bound of the overlap of two parts, along faces."""
    return min((a.off - (b.v @ a.n.T).min(0)).min(), (b.off - (a.v @ b.n.T).min(0)).min())


def half_spaces(a, b):
    """Unit axes u and depths h: part a leaves b when it moves by x with u . x >= h for any."""
    cross = np.cross(a.e[:, None, :], b.e[None, :, :]).reshape(-1, 3)
    length = np.linalg.norm(cross, axis=1)
    cross = cross[length > 1e-9] / length[length > 1e-9, None]
    u = np.concatenate([-a.n, b.n, cross, -cross])
    return u, (b.v @ u.T).max(0) - (a.v @ u.T).min(0)


def least_path(spaces):
    """Least path along an axis of any pair of parts that ends outside of all of them."""
    directions = np.concatenate([u for u, h in spaces])
    at = np.zeros(len(directions))
    ranges = []
    for u, h in spaces:  # each pair of parts overlaps along a range of each ray
        rate = directions @ u.T
        with np.errstate(divide="ignore", invalid="ignore"):
            t = h / rate
        end = np.where(rate > 1e-12, t, np.inf).min(1)
        begin = np.where(rate < -1e-12, t, -np.inf).max(1)
        never = ((np.abs(rate) <= 1e-12) & (h < 0)).any(1)
        ranges.append((np.where(never, np.inf, begin), end))
    for _ in ranges:
        for begin, end in ranges:
            at = np.where((begin <= at + 1e-12) & (end > at), end, at)
    return at.min()


def overlap_of(parts_a, parts_b, floor):
    """How far two bodies are in each other; a bound at or below `floor` may be returned instead."""
    bound, near = 0.0, []
    for a in parts_a:
        for b in parts_b:
            if (a.low > b.high).any() or (b.low > a.high).any():
                continue
            depth = face_overlap(a, b)
            if depth > 0:
                near.append((a, b))
                bound = max(bound, depth)
    if bound <= floor:
        return bound
    spaces = [half_spaces(a, b) for a, b in near]
    if not any((h > 0).all() for _, h in spaces):
        return 0.0
    return least_path(spaces)


class Bed:
    def __init__(self, path, origin, sample):
        raster = gdal.Open(path)
        x0, self.cell, _, y0, _, _ = raster.GetGeoTransform()
        self.z = raster.ReadAsArray().astype(float)
        nodata = raster.GetRasterBand(1).GetNoDataValue()
        self.z[self.z == nodata] = np.nan
        self.x0, self.y0 = x0 + self.cell / 2 - origin[0], y0 - self.cell / 2 - origin[1]
        self.z -= origin[2]
        self.per_cell = max(1, int(np.ceil(self.cell / sample)))
        self.step = self.cell / self.per_cell

    def height(self, x, y):
        c, r = (x - self.x0) / self.cell, (self.y0 - y) / self.cell
        rows, cols = self.z.shape
        known = (c >= 0) & (r >= 0) & (c <= cols - 1) & (r <= rows - 1)
        j = np.clip(np.floor(c), 0, cols - 2).astype(int)
        i = np.clip(np.floor(r), 0, rows - 2).astype(int)
        u, v = c - j, r - i
        nw, ne = self.z[i, j], self.z[i, j + 1]
        sw, se = self.z[i + 1, j], self.z[i + 1, j + 1]
        lower, upper = nw + v * (sw - nw) + u * (se - sw), nw + u * (ne - nw) + v * (se - ne)
        return np.where(known, np.where(v >= u, lower, upper), np.nan)

    def triangles(self, low, high):
        """Corners of the triangles over a range in plan."""
        rows, cols = self.z.shape
        j0 = max(0, int(np.floor((low[0] - self.x0) / self.cell)))
        j1 = min(cols - 2, int(np.floor((high[0] - self.x0) / self.cell)))
        i0 = max(0, int(np.floor((self.y0 - high[1]) / self.cell)))
        i1 = min(rows - 2, int(np.floor((self.y0 - low[1]) / self.cell)))
        def node(i, j):
            return [self.x0 + j * self.cell, self.y0 - i * self.cell, self.z[i, j]]
        for i in range(i0, i1 + 1):
            for j in range(j0, j1 + 1):
                nw, sw, se, ne = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
                yield np.array([nw, sw, se])
                yield np.array([nw, se, ne])

    def samples(self, low, high):
        """Points of the bed over a range in plan, nodes and edges among them."""
        j = np.arange(np.ceil((low[0] - self.x0) / self.step - 1e-9),
                      np.floor((high[0] - self.x0) / self.step + 1e-9) + 1)
        i = np.arange(np.ceil((self.y0 - high[1]) / self.step - 1e-9),
                      np.floor((self.y0 - low[1]) / self.step + 1e-9) + 1)
        x, y = np.meshgrid(self.x0 + j * self.step, self.y0 - i * self.step)
        x, y = x.ravel(), y.ravel()
        return np.stack([x, y, self.height(x, y)], 1)


def distance_to_polygon(x, loop, n):
    """Of a point from a convex polygon."""
    foot = x - n * (n @ (x - loop[0]))
    after = np.roll(loop, -1, 0)
    along = after - loop
    if (np.cross(along, foot - loop) @ n >= 0).all():
        return abs(n @ (x - loop[0]))
    t = np.clip(((x - loop) * along).sum(1) / (along * along).sum(1), 0, 1)
    return np.linalg.norm(x - loop - t[:, None] * along, axis=1).min()


def depth_of_vertices(bed, parts):
    """Distance from the bed of the vertex that is farthest below it."""
    v = np.concatenate([p.v for p in parts])
    below = bed.height(v[:, 0], v[:, 1]) - v[:, 2]
    deepest = 0.0
    for k in np.argsort(-np.nan_to_num(below)):
        drop = below[k]
        if not drop > deepest:
            break
        least = drop
        for corners in bed.triangles(v[k] - drop, v[k] + drop):
            if np.isfinite(corners).all():
                least = min(least, distance_to_polygon(v[k], corners, newell(corners)))
        deepest = max(deepest, least)
    return deepest


def depth_of_bed(bed, parts):
    """Distance from the body's surface of the sample of the bed that is farthest inside."""
    deepest = 0.0
    for p in parts:
        points = bed.samples(p.low, p.high)
        points = points[(points[:, 2] > p.low[2]) & (points[:, 2] < p.high[2])]
        for n, off in zip(p.n, p.off):
            points = points[points @ n < off]
        if not len(points):
            continue
        to_planes = p.off - points @ p.n.T
        if len(parts) == 1:
            deepest = max(deepest, to_planes.min(1).max())
            continue
        bound = to_planes[:, p.part.bare].min(1) if p.part.bare.any() else to_planes.max(1)
        for k in np.argsort(-bound):
            if bound[k] <= deepest:
                break
            x = (points[k] - p.position) @ p.turn
            deepest = max(deepest, min(
                distance_to_polygon(x, q.part.loops[f], q.part.n[f])
                for q in parts for f in range(len(q.part.loops)) if q.part.bare[f]))
    return deepest


class Found:
    """Result of brute force for a block that was deep."""

    def __init__(self):
        self.steps, self.first, self.time, self.depth, self.partner = 0, None, None, 0.0, None


class Study:
    def __init__(self, args):
        self.run = h5py.File(args.run)
        blocks = h5py.File(args.blocks)
        if "strain" in self.run["frames"]:
            sys.exit("overlaps.py: the run's blocks strain, expected rigid ones")
        if self.run.attrs["blocks_hash"] != blocks.attrs["content_hash"]:
            sys.exit("overlaps.py: the run was not made from these blocks")
        self.bodies, self.thickness = read_bodies(self.run, blocks)
        self.bed = Bed(args.trn, self.run.attrs["origin_m"], args.sample_m)
        self.floor = args.floor
        self.radius = np.array([max(np.linalg.norm(p.v, axis=1).max() for p in parts)
                                for parts in self.bodies])
        self.position = self.run["frames/position_m"]
        self.attitude = self.run["frames/attitude"]
        self.time = self.run["frames/time_s"][:]
        phase = self.run["blocks/phase"][:]
        self.left = (phase == LEFT_TERRAIN) | (phase == UNBORN)
        self.deep, self.rows = {}, []
        self.before = None

    def partners(self, position):
        """Pairs of blocks whose balls meet."""
        for a in range(len(position) - 1):
            near = np.linalg.norm(position[a + 1:] - position[a], axis=1)
            for b in np.nonzero(near < self.radius[a + 1:] + self.radius[a])[0] + a + 1:
                yield a, int(b)

    def look_at(self, frame):
        position = self.position[frame]
        attitude = self.attitude[frame].astype(float)
        still = np.zeros(len(position), bool)
        if self.before is not None:
            still = (position == self.before[0]).all(1) & (attitude == self.before[1]).all(1)
        placed = [[Placed(p, position[b], rotation(attitude[b])) for p in parts]
                  for b, parts in enumerate(self.bodies)]
        worst, in_frame = (0.0, None, None), {}

        def note(block, partner, depth, moves):
            nonlocal worst
            if moves and depth > worst[0]:
                worst = (depth, block, partner)
            if depth > in_frame.get(block, (0.0, None))[0]:
                in_frame[block] = (depth, partner)

        gone = self.left & still
        for a, b in self.partners(position):
            if gone[a] or gone[b]:
                continue
            thin, other = (b, a) if self.thickness[b] < self.thickness[a] else (a, b)
            depth = overlap_of(placed[a], placed[b], self.floor * self.thickness[thin])
            note(thin, other, depth, not (still[a] and still[b]))
        for b, parts in enumerate(placed):
            if not gone[b]:
                depth = max(depth_of_vertices(self.bed, parts), depth_of_bed(self.bed, parts))
                note(b, -1, depth, not still[b])
        for block, (depth, partner) in in_frame.items():
            if depth > DEEP * self.thickness[block]:
                row = self.deep.setdefault(block, Found())
                row.steps += 1
                row.first = self.time[frame] if row.first is None else row.first
                if depth > row.depth:
                    row.depth, row.partner, row.time = depth, partner, self.time[frame]
        self.rows.append((frame, *worst))
        self.before = position, attitude


def word(partner):
    return {-1: "the bed", -2: "a fence", -3: "the fixed slope"}.get(partner, f"block {partner}")


def compare_deep(study, step, every, window):
    """Blocks that are deep by either: lines of words, and those that differ."""
    told, differ = [], []
    recorded = {}
    if "deep_blocks" in study.run:
        table = {k: v[:] for k, v in study.run["deep_blocks"].items()}
        recorded = {int(b): {k: v[i] for k, v in table.items()}
                    for i, b in enumerate(table["block"])}
    for block in sorted(set(recorded) | set(study.deep)):
        by_health, by_force = recorded.get(block), study.deep.get(block)
        thickness = study.thickness[block]
        words = f"block {block}, {thickness:.3f} m thick: "
        if by_health is not None and not window[0] <= by_health["time_s"] <= window[1]:
            continue
        if by_health is not None and by_health["partner"] < -1:
            told.append(words + f"health says {word(int(by_health['partner']))}: not judged")
            continue
        if by_health is not None:
            words += (f"health {by_health['depth_m']:.4f} m in {word(int(by_health['partner']))} "
                      f"at {by_health['time_s']:.3f} s, {by_health['steps']} steps")
        else:
            words += "health nothing"
        if by_force is not None:
            words += (f"; brute force {by_force.depth:.4f} m in {word(by_force.partner)} "
                      f"at {by_force.time:.3f} s, {by_force.steps} frames")
        else:
            words += "; brute force nothing"
        near = study.bed.step / 2 if (by_force or by_health) and (
            (by_force.partner if by_force else by_health["partner"]) == -1) else 0.0
        if by_health is None or by_force is None:
            depth = by_force.depth if by_force else by_health["depth_m"]
            same = depth - DEEP * thickness < 0.02 * depth + near
        else:
            d, f = by_health["depth_m"], by_force.depth
            same = abs(d - f) <= 0.02 * max(d, f) + near
            same &= int(by_health["partner"]) == by_force.partner
            if every == 1:
                slow = abs(by_health["time_s"] - by_force.time) <= 1.5 * step
                same &= slow or abs(d - f) <= 0.02 * max(d, f)
                same &= abs(by_health["steps"] - by_force.steps) <= max(
                    2, 0.05 * by_force.steps) or near > 0
        told.append(words)
        if not same:
            differ.append(words)
    return told, differ


def compare_rows(study):
    """Frames in which bodies that move are in farther than recorded, or much less."""
    health = study.run["health/largest_penetration_m"][:]
    time = study.run["health/time_s"][:]
    slack = SUSPECT * study.thickness.max()
    differ, excess = [], 0.0
    for frame, depth, block, partner in study.rows:
        row = int(np.argmin(np.abs(time - study.time[frame])))
        if frame == 0 or abs(time[row] - study.time[frame]) > 1e-6 * max(1, time[row]):
            continue
        said = health[row]
        near = study.bed.step / 2 if partner == -1 else 0.0
        floor = 0 if block is None else study.floor * study.thickness[block]
        excess = max(excess, said - depth)
        if depth > 1.02 * said + floor + 1e-6 or said > depth + slack + near:
            differ.append((float(study.time[frame]), float(depth), block, partner, float(said)))
    return differ, excess


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run")
    parser.add_argument("--blocks", required=True)
    parser.add_argument("--trn", required=True)
    parser.add_argument("--every", type=int, default=1, help="look at every Nth frame")
    parser.add_argument("--from", dest="begin", type=float, default=0)
    parser.add_argument("--to", dest="end", type=float, default=np.inf)
    parser.add_argument("--sample-m", type=float, default=0.1)
    parser.add_argument("--floor", type=float, default=0.01)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    study = Study(args)
    frames = [k for k in range(len(study.time)) if args.begin <= study.time[k] <= args.end]
    for k in frames[::args.every]:
        study.look_at(k)
    step = float(np.median(np.diff(study.time))) if len(study.time) > 1 else 0
    told, deep_differ = compare_deep(study, step, args.every, (args.begin, args.end))
    row_differ, excess = compare_rows(study)
    largest = max(study.rows, key=lambda row: row[1], default=(0, 0.0, None, None))
    if args.json:
        print(json.dumps({"frames": len(study.rows), "largest_m": largest[1], "deep": told,
                          "deep_that_differ": deep_differ, "rows_that_differ": row_differ}))
    else:
        print(f"{len(study.rows)} frames; largest overlap of bodies that move "
              f"{largest[1]:.4f} m" + ("" if largest[2] is None else
              f": block {largest[2]} in {word(largest[3])} at {study.time[largest[0]]:.3f} s"))
        for words in told:
            print(("DIFFERS  " if words in deep_differ else "agrees   ") + words)
        print(f"largest penetration: {len(row_differ)} frames of {len(study.rows)} differ; "
              f"health says at most {excess:.4f} m more than brute force")
        for time, depth, block, partner, said in sorted(
                row_differ, key=lambda row: -abs(row[1] - row[4]))[:10]:
            who = "nobody" if block is None else f"block {block} in {word(partner)}"
            print(f"  {time:.3f} s: brute force {depth:.4f} m, {who}; health {said:.4f} m")
    sys.exit(1 if deep_differ or row_differ else 0)


if __name__ == "__main__":
    main()
