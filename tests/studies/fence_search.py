#!/usr/bin/env python3
"""Whether a fence that talus-fence-search proposes lets through what was predicted, on the four shared sites.

  python3 tests/studies/fence_search.py OUT [--bin FOLDER] [--runs N] [--repetitions R] [--again M] [--rocks K]
                                        [SITE...]

On each site rocks of 0.3 m3 fall from a grid over the release polygon, each as if alone; friction and restitution of
the ground scatter between runs. The object is an assumed track, 40 m long, across the expected path where the energy
line of 35 degrees ends. N runs are searched, contours and lines of equal distance; the cheapest proposal of both
then stands in R times M runs with fresh seeds, and each M of these are one repetition. Printed: the share of runs in
which a rock still comes to the object, predicted with its interval, and of each repetition; how many of them
lie inside; the least share of a repetition that would lie outside; all repetitions together.

Inside: the difference of both shares has zero in its 95 % interval (Newcombe, of both Wilson intervals), so it holds
what chance does to the prediction and to the repetition. All repetitions stand beside one prediction: where chance
has led that astray, all are shifted alike.

What is in OUT already is not computed again. Needs python3-h5py; ../shared/data beside the checkout.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys

root = os.path.abspath(os.path.join(os.path.dirname(__file__), '..', '..'))
shared = os.path.join(os.path.dirname(root), 'shared')
sites = ('salisbury_crags', 'gschnitz_gar', 'lechtal_kotcliff', 'lechtal_kotdam')


def wilson(share, n, z=1.959964):
    middle = (share + z * z / 2 / n) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(share * (1 - share) / n + z * z / 4 / n / n)
    return max(0, middle - half), min(1, middle + half)


def agree(a, of_a, b, of_b):
    below, above = math.hypot(a - of_a[0], of_b[1] - b), math.hypot(of_a[1] - a, b - of_b[0])
    return a - b - below <= 0 <= a - b + above


def area_of(ring):
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))) / 2


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


def write_site(site, folder, rocks):
    """The sample site with rocks instead of its mass, without its fence, with an object and a search."""
    kept, text = True, ''
    with open(f'{root}/sample_sites/{site}/site.toml', encoding='utf-8') as file:
        for line in file:
            if line.startswith('['):
                kept = not re.match(r'\[(joints|fence|source)', line)
            if kept and not re.match(r'failure_surface|depth_m', line):
                text += line.replace('../../../shared', shared)
            if line.startswith('[ground.slope]'):
                text += 'rolling_resistance = 0.25\ncor = 0.3\n'
    scenario = json.load(open(f'{shared}/data/scenarios/{site}.json', encoding='utf-8'))
    track = across(scenario)
    spacing = math.sqrt(area_of(scenario['release']['polygon']) / rocks)
    text += f'''
[rockfall.rock]
shape = "rock"
size_m = [1.2, 1.0, 0.8]
polygon_file = "{shared}/data/scenarios/{site}.gpkg|layername=release"
release_spacing_m = {spacing:.2f}
height_above_ground_m = 0.5

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
    os.makedirs(folder, exist_ok=True)
    with open(f'{folder}/site.toml', 'w', encoding='utf-8') as file:
        file.write(text)
    with open(f'{root}/sample_sites/{site}/Makefile', encoding='utf-8') as file:
        makefile = file.read().replace('../../../shared', shared).replace('../../pipelines', f'{root}/pipelines')
    with open(f'{folder}/Makefile', 'w', encoding='utf-8') as file:
        file.write(makefile)


def command(folder, log, *words, allowed=(0,)):
    with open(f'{folder}/{log}', 'a', encoding='utf-8') as file:
        done = subprocess.run(words, cwd=folder, stdout=file, stderr=subprocess.STDOUT, check=False)
    if done.returncode not in allowed:
        sys.exit(f'{words[0]} ended with {done.returncode}: see {folder}/{log}')


def run(folder, tools, name, seed, *more):
    """A run that is not there yet, also one that breaks a limit of its health (3). None where it takes 5 s of
    processor time, thirty times that of the others."""
    out = f'{name}/run_{seed}.h5'
    os.makedirs(f'{folder}/{name}', exist_ok=True)
    if not os.path.exists(f'{folder}/{out}') and not os.path.exists(f'{folder}/{out}.endless'):
        command(folder, 'runs.log', 'sh', '-c', 'ulimit -t 5; "$@"', 'sh', f'{tools}talus-dda', 'site.toml', '--trn',
                'out/bed.tif', '--blocks', 'out/blocks.h5', '--seed', str(seed), '--no-db', '-o', out,
                *more, allowed=(0, 3, 137, 152, -9, -24))
        if not os.path.exists(f'{folder}/{out}'):
            open(f'{folder}/{out}.endless', 'w', encoding='utf-8').close()
            print(f'{folder}: seed {seed} took more than 5 s of processor time and is left out', flush=True)
    return out if os.path.exists(f'{folder}/{out}') else None


def hits_in(file):
    """Hits on the object; None where the run broke a limit of its health, as the tool leaves it out."""
    import h5py
    with h5py.File(file) as run_file:
        if run_file.attrs['status'] == b'failed':
            return None
        return len(run_file['object_hits/block']) if 'object_hits' in run_file else 0


def study(site, options):
    folder, tools = os.path.join(os.path.abspath(options.out), site), options.bin
    if not os.path.exists(f'{folder}/out/blocks.h5'):
        write_site(site, folder, options.rocks)
        command(folder, 'make.log', 'make', f'BIN={tools}', 'OUT=out', 'blocks')
    first = [file for seed in range(1, options.runs + 1) if (file := run(folder, tools, 'search', seed))]
    search = [f'{tools}talus-fence-search', 'site.toml', *first, '--trn', 'out/bed.tif', '--no-db', '--overwrite',
              '--n-proposals', '1', '-o', 'search.gpkg', '--json', 'search.json', '--charts',
              'charts', '--proposals', 'proposals']
    command(folder, 'search.log', *search)
    both = json.load(open(f'{folder}/search.json', encoding='utf-8'))['searches']
    for found in both:
        print(f'{site}, {found["answer"]}', flush=True)
    both = [found for found in both if found['proposals']]
    if not both:
        return
    found = min(both, key=lambda one: one['proposals'][0]['cost'])
    fence = found['proposals'][0]
    predicted, interval = fence['residual_run_share'], fence['residual_interval']
    name = fence['name']
    seeds = range(options.runs + 1, options.runs + 1 + options.repetitions * options.again)
    again = [run(folder, tools, f'with_{name}', seed, '--add', f'proposals/{name}.toml', '--set', 'output.frames=false')
             for seed in seeds]
    counted = [hits_in(f'{folder}/{file}') if file else None for file in again]
    groups = [[h for h in counted[k:k + options.again] if h is not None] for k in range(0, len(counted), options.again)]
    n = options.again
    hits = [h for group in groups for h in group]
    again = [file for file in again if file]
    shares = [sum(h > 0 for h in group) / len(group) for group in groups]
    inside = sum(agree(predicted, interval, share, wilson(share, len(group))) for share, group in zip(shares, groups))
    outside = next((k for k in range(math.ceil(predicted * n), n + 1)
                    if not agree(predicted, interval, k / n, wilson(k / n, n))), n)
    together = sum(h > 0 for h in hits) / len(hits)
    bounds = wilson(together, len(hits))
    # the tool's own comparison, of all repetitions as one
    with open(f'{folder}/list', 'w', encoding='utf-8') as file:
        file.write('\n'.join(again) + '\n')
    command(folder, 'search.log', *search, '--verified', f'{name}=@list')
    verified = next(one['proposals'][0]['verified'] for one in
                    json.load(open(f'{folder}/search.json', encoding='utf-8'))['searches']
                    if one['name'] == found['name'])
    assert abs(verified['residual_run_share'] - together) < 1e-12, verified
    percent = '{:.3g}'.format
    failed = len(again) - len(hits)
    if failed:
        print(f'  {failed} of {len(again)} runs with the fence broke a limit of their health and are left out')
    print(f'  hit without a fence in {percent(100 * found["run_share"])} % of {found["n_runs"]} runs, '
          f'{found["hits_a_run"]:.2f} hits a run; predicted {percent(100 * predicted)} % '
          f'({percent(100 * interval[0])} - {percent(100 * interval[1])})\n'
          f'  repetitions of {n} runs: {", ".join(percent(100 * share) for share in shares)} %: '
          f'{inside} of {len(shares)} inside; outside from {percent(100 * outside / n)} % on\n'
          f'  together {percent(100 * together)} % ({percent(100 * bounds[0])} - {percent(100 * bounds[1])}), '
          f'{verified["comparison"]}; of the hits {percent(100 * fence["stopped_share"])} % stopped as predicted, '
          f'{percent(100 * verified["stopped_share"])} % as verified', flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('out')
    parser.add_argument('site', nargs='*', default=sites)
    parser.add_argument('--bin', default=f'{root}/build/release/tools')
    parser.add_argument('--runs', type=int, default=100)
    parser.add_argument('--repetitions', type=int, default=10)
    parser.add_argument('--again', type=int, default=100)
    parser.add_argument('--rocks', type=float, default=5, help='to the area of the release polygon in plan')
    options = parser.parse_intermixed_args()
    options.bin = options.bin.rstrip('/') + '/'
    if not os.path.isdir(f'{shared}/data'):
        sys.exit('skipped: no ../shared/data')
    for site in options.site:
        study(site, options)


if __name__ == '__main__':
    main()
