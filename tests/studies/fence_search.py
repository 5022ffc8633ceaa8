#!/usr/bin/env python3
"""Whether a fence that talus-fence-search proposes lets through as many runs as predicted, on the four shared sites.

On each site rocks of 0.3 m3 fall from a grid over the release polygon, each as if alone; friction and restitution of
the ground scatter between runs. The object is an assumed track, 40 m long, across the expected path where the energy
line of 35 degrees ends. 100 runs are searched, contours and lines of equal distance; the cheapest proposal of both
is then built in ten times 100 runs with other seeds, and each 100 of these are one repetition. Reported: the share of
runs in which a rock still comes to the object, predicted and of all repetitions, and how many of these agree.

They agree where the difference of both shares has zero in its 95 % interval (Newcombe, of both Wilson intervals), which holds
the effect of chance on the prediction and on the repetition. All repetitions have one prediction: where chance
has led that astray, all are shifted alike.
"""
import json
import math
import re

import h5py

from real_sites import SITES, scenario_of, write_rock_site
from study import Study

RUNS, REPETITIONS, ROCKS = 100, 10, 5  # runs searched, and of a repetition; rocks to the area of the release polygon


def wilson(share, n, z=1.959964):
    middle = (share + z * z / 2 / n) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(share * (1 - share) / n + z * z / 4 / n / n)
    return max(0, middle - half), min(1, middle + half)


def agree(a, of_a, b, of_b):
    below, above = math.hypot(a - of_a[0], of_b[1] - b), math.hypot(of_a[1] - a, b - of_b[0])
    return a - b - below <= 0 <= a - b + above


def across(scenario, half=20):
    """A track across the expected path where the energy line of 35 degrees ends."""
    end = scenario['energy_line_stops']['35']
    here = [end['x'], end['y']]
    nearest = min(range(1, len(scenario['path']['points']) - 1),
                  key=lambda i: math.dist(here, scenario['path']['points'][i][:2]))
    before, after = (scenario['path']['points'][nearest + k] for k in (-1, 1))
    along = [after[0] - before[0], after[1] - before[1]]
    size = math.hypot(*along)
    return [[round(here[0] + k * half * along[1] / size, 1), round(here[1] - k * half * along[0] / size, 1)]
            for k in (-1, 1)]


SEARCH = '''
[object.track]
line = {track}
width_m = 6

[fence_search.contour]
protect = "track"
heights_m = [3, 4, 5, 6, 7, 8]

[fence_search.offset]
protect = "track"
style = "offset"
heights_m = [3, 4, 5, 6, 7, 8]

[solver]
duration_s = 50
friction_scatter_deg = 2
cor_scatter = 0.05
max_lost_share = 1
'''


def run(study, folder, name, seed, *more):
    """A run, also one that breaks a limit of its health (3). None where it takes 5 s of processor time, thirty times
    that of the rest."""
    out = folder / name / f'run_{seed}.h5'
    out.parent.mkdir(exist_ok=True)
    if not out.exists():
        study.run('sh', '-c', 'ulimit -t 5; "$@"', 'sh', 'talus-dda', 'site.toml', '--trn', 'out/bed.tif', '--blocks',
                  'out/blocks.h5', '--seed', seed, '--no-db', '-o', out, *more, cwd=folder, codes=(0, 3, 137, 152, -9, -24))
        if not out.exists():
            print(f'{folder}: seed {seed} took more than 5 s of processor time and is left out', flush=True)
    return out if out.exists() else None


def hits_in(file):
    """Hits on the object; None where the run broke a limit of its health, as the tool leaves it out."""
    with h5py.File(file) as run_file:
        if run_file.attrs['status'] == b'failed':
            return None
        return len(run_file['object_hits/block']) if 'object_hits' in run_file else 0


STUDY = Study(__file__, __doc__)


def compute(study, site):
    folder = study.out / site
    scenario = scenario_of(study, site)
    write_rock_site(study, site, folder, ROCKS, 'joints|fence|source', SEARCH.format(track=across(scenario)),
                    'rolling_resistance = 0.25\ncor = 0.3\n')
    study.make(folder, 'OUT=out', 'blocks')
    first = [file for seed in range(1, RUNS + 1) if (file := run(study, folder, 'search', seed))]
    search = ['talus-fence-search', 'site.toml', *first, '--trn', 'out/bed.tif', '--no-db', '--overwrite', '--n-proposals', '1',
              '-o', 'search.gpkg', '--json', 'search.json', '--proposals', 'proposals']
    study.run(*search, cwd=folder)
    searches = json.loads((folder / 'search.json').read_text())['searches']
    both = [found for found in searches if found['proposals']]
    hit = {'hit without a fence [%]': f"{100 * searches[0]['run_share']:.0f}"}
    if not both:
        answer = searches[0]['answer']
        nearest, height = re.search(r'stops ([\d.]+) % of the hits', answer), re.search(r'needs a height of ([\d.]+) m', answer)
        study.row('sites', site, hit | {'fence': f'none of this kind: the nearest stops {nearest[1]} % of the hits, and would need {height[1]} m of height'})
        return
    found = min(both, key=lambda one: one['proposals'][0]['cost'])
    fence = found['proposals'][0]
    predicted, interval, name = fence['residual_run_share'], fence['residual_interval'], fence['name']
    again = [run(study, folder, f'with_{name}', seed, '--add', f'proposals/{name}.toml', '--set', 'output.frames=false')
             for seed in range(RUNS + 1, RUNS + 1 + REPETITIONS * RUNS)]
    counted = [hits_in(file) if file else None for file in again]
    groups = [[h for h in counted[k:k + RUNS] if h is not None] for k in range(0, len(counted), RUNS)]
    shares = [(sum(h > 0 for h in group) / len(group), len(group)) for group in groups]
    inside = sum(agree(predicted, interval, share, wilson(share, n)) for share, n in shares)
    hits = [h for group in groups for h in group]
    together = sum(h > 0 for h in hits) / len(hits)
    percent = lambda *values: tuple(f'{100 * value:.3g}' for value in values)
    study.row('sites', site, hit | {
        'fence': f"{fence['length_m']:.0f} m, {fence['height_m']:.0f} m high, {fence['capacity_kj']:,.0f} kJ", 'still hit, predicted [%]': percent(predicted, *interval),
        'verified [%]': percent(together, *wilson(together, len(hits))), 'groups': len(groups), 'groups that agree': inside,
        'runs left out': len(counted) - len(hits)})


for one in SITES:
    STUDY.part(one, 120)(lambda study, site=one: compute(study, site))

if __name__ == '__main__':
    STUDY.main()
