#!/usr/bin/env python3
"""What talus-check forecasts beside what a run does: the share of the mass that moves, and the time.

  python3 tests/studies/forecast.py OUT [--bin FOLDER] [--drawn N] [--seed K] [--duration S] [--jobs J] [FOLDER...]

For each site: `make check`, then one run. The share of the mass that the probe sees on its way stands beside the share
that moved more than 1 m by the end; the time that the check says for this machine beside the processor time of
talus-dda. Sites: FOLDER..., else the four shared slopes, a slope of the Serles and N (10) drawn at random
(forecast_sites.py). Drawn sites that offer no mass (refused by the check, or no plane daylights) are named and
replaced by the next ones drawn. What is in OUT already is not computed again; sites.csv there holds the table.
Needs python3-gdal.
"""
import argparse
import concurrent.futures
import csv
import json
import os
import re
import subprocess
import sys

import forecast_sites

root = forecast_sites.root
shared = ('salisbury_crags', 'gschnitz_gar', 'lechtal_kotcliff', 'lechtal_kotdam')


def kind(share):
    return 'stands' if share < .1 else 'goes' if share > .9 else 'goes in part'


def seconds_said(words):
    number, unit = re.search(r'a run takes about ([\d.]+) (s|min|h) of one core', words).groups()
    return float(number) * {'s': 1, 'min': 60, 'h': 3600}[unit]


def make(folder, out, options, goals, log):
    tools = [f'BIN={options.bin}/'] if options.bin else []
    duration = f'--set solver.duration_s={options.duration}' if options.duration else ''
    command = ['make', '-C', folder, *tools, f'OUT={out}', 'RUNS=1', 'WITHOUT=no', f'CHECK_FLAGS={duration}',
               f'DDA_FLAGS=--json {duration}', *goals]
    with open(log, 'w', encoding='utf-8') as file:
        return subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, check=False).returncode


def result_of(folder, options):
    """A row of the table, or why there is none."""
    name = os.path.basename(folder.rstrip('/'))
    out = os.path.join(options.out, name)
    logs = [f'{out}.check.log', f'{out}.run.log']
    if not os.path.exists(f'{out}/runout.json'):
        for log, goals in zip(logs, (['check'], ['runs', 'runout'])):
            if make(folder, out, options, goals, log) != 0 and goals == ['check']:
                break
    said = open(logs[0], encoding='utf-8').read()
    if not os.path.exists(f'{out}/runout.json'):
        words = said + (open(logs[1], encoding='utf-8').read() if os.path.exists(logs[1]) else '')
        line = next((line for line in words.splitlines() if re.match(r'talus-\w+: ', line)), 'see ' + out)
        return {'site': name, 'why_not': line[:160]}
    check, runout = (json.load(open(f'{out}/{file}.json', encoding='utf-8')) for file in ('check', 'runout'))
    cpu = float(re.search(r'"cpu_time_s":\s*([\d.e+-]+)', open(logs[1], encoding='utf-8').read()).group(1))
    probe = check.get('probe')
    if probe is None:
        return {'site': name, 'why_not': 'was not probed'}
    return {'site': name, 'blocks': check['n_blocks'], 'forecast': round(probe['moved_share'], 3),
            'moved': round(runout['moved']['share_moved_1_m'], 3), 'said_s': seconds_said(said), 'cpu_s': round(cpu, 2)}


def summary(rows):
    off = [row['forecast'] - row['moved'] for row in rows]
    right = sum(kind(row['forecast']) == kind(row['moved']) for row in rows)
    # What takes less than a second is said to take one.
    ratios = [row['said_s'] / max(1, row['cpu_s']) for row in rows]
    return (f'{len(rows)} sites: share rms {(sum(d * d for d in off) / len(off)) ** .5:.3f}, mean {sum(off) / len(off):+.3f}, '
            f'worst {max(off, key=abs):+.2f}, class right in {right}; time said over used {min(ratios):.2f} to '
            f'{max(ratios):.2f}, within a factor of 2.5 in {sum(.4 <= ratio <= 2.5 for ratio in ratios)}')


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('out')
    parser.add_argument('folders', nargs='*')
    parser.add_argument('--bin', default='')
    parser.add_argument('--drawn', type=int, default=10)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--duration', type=float, default=0)
    parser.add_argument('--jobs', type=int, default=1)
    options = parser.parse_intermixed_args()
    if not options.folders and not os.path.isdir(f'{root}/../shared/data'):
        sys.exit('skipped: no ../shared/data')
    options.out = os.path.abspath(options.out)
    sites = os.path.join(options.out, 'sites')
    os.makedirs(sites, exist_ok=True)
    rows = []

    def take(row):
        print(row['site'] + ': ' + (row['why_not'] if 'why_not' in row else
              f"forecast {row['forecast']:.2f}, moved {row['moved']:.2f}; {kind(row['forecast'])}, {kind(row['moved'])}; "
              f"{row['blocks']} blocks; {row['said_s']:.0f} s said, {row['cpu_s']:.1f} s used"), flush=True)
        if 'why_not' not in row:
            rows.append(row)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        folders = options.folders or [forecast_sites.serles(sites)] + [f'{root}/sample_sites/{name}' for name in shared]
        for row in pool.map(lambda folder: result_of(folder, options), folders):
            take(row)
        draw = forecast_sites.drawn(sites, options.seed)
        lacking = 0 if options.folders else options.drawn
        while lacking > 0:
            before = len(rows)
            for row in pool.map(lambda folder: result_of(folder, options), [next(draw) for _ in range(lacking)]):
                take(row)
            lacking -= len(rows) - before
    with open(os.path.join(options.out, 'sites.csv'), 'w', encoding='utf-8', newline='') as file:
        table = csv.DictWriter(file, ['site', 'blocks', 'forecast', 'moved', 'said_s', 'cpu_s'])
        table.writeheader()
        table.writerows(rows)
    print(summary(rows))


main()
