#!/usr/bin/env python3
"""Columns of blocks that are let go on a floor, beside columns of grains: blocks that move as a mass.

Lube et al. 2004 (J. Fluid Mech. 508, 175): the radius grows by 1.24 a of itself up to a = height / radius = 1.7, by
1.6 a^0.5 beyond, for all grains.

A column is poured into a round fence on a level floor and comes to rest; then the fence is taken away. Its
height is twice that of its centre of mass. Its final radius is the mean over 24 sectors of the farthest block
of the heap, which are all that are nearer than 1.5 blocks to one of it; the middle of the heap is in it.
"""
import numpy as np

import field
from study import Study


class Columns:
    """Columns of blocks on a level floor."""
    SPACING = 1.1  # of the blocks that are poured in [m]; they are 1 m large
    CASES = ((300, 5, 15), (600, 5, 15), (300, 5, 25), (820, 7, 25), (600, 5, 25), (1200, 5, 25))

    def __init__(self, tools):
        self.tools = tools
        tools.terrain("floor", np.zeros((80, 80)), (-40, 1, 0, 40, 0, -1))

    def places(self, n, radius):
        at = np.arange(-radius, radius + 0.01, self.SPACING)
        layer = [(x, y) for x in at for y in at if np.hypot(x, y) < 0.99 * radius - 0.6]
        return [[x, y, 0.7 + self.SPACING * (i // len(layer))] for i in range(n) for x, y in [layer[i % len(layer)]]]

    def heap(self, ends, radius):
        """Distances from the middle of the blocks of the heap, and their directions."""
        near = np.hypot(*(ends[:, None] - ends[None]).transpose(2, 0, 1)) < 1.5
        heap = np.hypot(*ends.T) < radius / 2
        while (grown := near[heap].any(0)).sum() > heap.sum():
            heap = grown
        return np.hypot(*ends[heap].T), np.arctan2(ends[heap, 1], ends[heap, 0])

    def simulate(self, n, radius, friction_deg):
        """Height of the column of `n` blocks; radius of the heap, and that which holds 95 % of the blocks."""
        circle = [[radius * np.cos(t), radius * np.sin(t)] for t in np.linspace(0, 2 * np.pi, 25)]
        site = field.SITE.format(2650, 20, "false", 1).replace("[solver]", f"friction_deg = {friction_deg}\n[solver]")
        site += f"[ground.floor]\nfriction_deg = {friction_deg}\n[blocks.grains]\n"
        name = f"column{n}_{radius}_{friction_deg}"
        poured = site + 'shape = "rock"\nsize_m = [1]\nrandom_orientation = true\n'
        poured += f"position_m = {self.places(n, radius)}\n[fence.wall]\nline = {circle}\nheight_m = 40\npost_spacing_m = 2\n"
        self.tools.simulate(f"poured_{name}", poured, "floor").close()
        self.tools.run("talus-export", f"poured_{name}.h5", "-o", f"{name}.obj")
        with self.tools.simulate(name, site + f'file = "{name}.obj"\n', "floor") as run:
            at = run["frames/position_m"][:] + run["frames"].attrs["origin_m"]
            mass = run["blocks/mass_kg"][:]
        height = 2 * np.average(at[0, :, 2], weights=mass)
        distance, direction = self.heap(at[-1, :, :2], radius)
        sector = ((direction + np.pi) / (2 * np.pi) * 24).astype(int) % 24
        edge = np.mean([distance[sector == s].max(initial=0) for s in range(24)]) + 0.5
        return height, edge, np.percentile(np.hypot(*at[-1, :, :2].T), 95)

    def add_row(self, n, radius, friction):
        height, *radii = self.simulate(n, radius, friction)
        a = height / radius
        seen, (made, most) = 1.24 * a if a < 1.7 else 1.6 * a ** 0.5, (r / radius - 1 for r in radii)
        self.tools.study.row("columns", f"{n} blocks, radius {radius}, {friction} degrees", {
            "height over radius": f"{a:.2f}", "growth of the radius, observed": f"{seen:.2f}", "computed": f"{made:.2f}",
            "of 95 % of the blocks": f"{most:.2f}", "computed over observed": f"{made / seen:.2f}"})


STUDY = Study(__file__, __doc__)

for case in Columns.CASES:
    STUDY.part("{}_{}_{}".format(*case), 100)(lambda study, case=case: Columns(field.Tools(study)).add_row(*case))

if __name__ == "__main__":
    STUDY.main()
