#!/usr/bin/env python3
"""What talus-check forecasts beside what a run does: the share of the mass that moves, and the time.

  python3 tests/studies/forecast.py OUT [--bin FOLDER] [--drawn N] [--seed K] [--duration S] [--most-s S] [--jobs J]
                                    [FOLDER...]

All sites are looked at first (`make check`); then each gets one run, the cheapest first; a site that is said to
take more than --most-s of processor time is named and left out. The share of the mass that the probe sees on its way stands beside the share
that moved more than 1 m by the end; the time that the check says for this machine beside the processor time of
talus-dda. Sites: FOLDER..., else the four shared slopes, a slope of the Serles and N (10) drawn at random
(forecast_sites.py). Drawn sites that offer no mass (refused by the check, or no plane daylights) are named and
replaced by the next ones drawn. What is in OUT already is not computed again, so the study can be ended and begun anew
at any time; sites.csv there holds the table of what is known so far. Needs python3-gdal.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import re
import subprocess
import sys

import forecast_sites

root = forecast_sites.root
shared = ('gschnitz_gar', 'lechtal_kotcliff', 'lechtal_kotdam', 'salisbury_crags')  # the dearest last


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


def first_message(*logs):
    lines = [line for log in logs if os.path.exists(log) for line in open(log, encoding='utf-8')]
    return next((line.strip() for line in lines if re.match(r'talus-\w+: (?!warning)', line)), f'see {logs[-1]}')[:160]


def looked_at(folder, options):
    """What the check says of a site, or why it says nothing."""
    name = os.path.basename(folder.rstrip('/'))
    out = os.path.join(options.out, name)
    log = f'{out}.check.log'
    row = {'site': name, 'folder': folder}
    if not os.path.exists(f'{out}/check.json') or not os.path.exists(log):
        if make(folder, out, options, ['check'], log) != 0:
            return {**row, 'why_not': first_message(log)}
    check = json.load(open(f'{out}/check.json', encoding='utf-8'))
    if any(doubt['refused'] for doubt in check['doubts']):
        return {**row, 'why_not': first_message(log)}
    if 'probe' not in check:
        return {**row, 'why_not': 'was not probed'}
    return {**row, 'blocks': check['n_blocks'], 'forecast': round(check['probe']['moved_share'], 3),
            'said_s': seconds_said(open(log, encoding='utf-8').read())}


def run(row, options):
    """The same row with what a run of the site gave, or why it gave nothing."""
    out = os.path.join(options.out, row['site'])
    log = f'{out}.run.log'
    if not os.path.exists(f'{out}/runout.json'):
        if row['said_s'] > options.most_s:
            return {**row, 'why_not': f"not run: it is said to take {row['said_s']:.0f} s"}
        make(row['folder'], out, options, ['runs', 'runout'], log)
    if not os.path.exists(f'{out}/runout.json'):
        return {**row, 'why_not': first_message(log)}
    runout = json.load(open(f'{out}/runout.json', encoding='utf-8'))
    cpu = float(re.search(r'"cpu_time_s":\s*([\d.e+-]+)', open(log, encoding='utf-8').read()).group(1))
    return {**row, 'moved': round(runout['moved']['share_moved_1_m'], 3), 'cpu_s': round(cpu, 2)}


def summary(rows):
    off = [row['forecast'] - row['moved'] for row in rows]
    right = sum(kind(row['forecast']) == kind(row['moved']) for row in rows)
    # What takes less than a second is said to take one.
    ratios = [row['said_s'] / max(1, row['cpu_s']) for row in rows]
    return (f'{len(rows)} sites: share rms {(sum(d * d for d in off) / len(off)) ** .5:.3f}, mean {sum(off) / len(off):+.3f}, '
            f'worst {max(off, key=abs):+.2f}, class right in {right}; time said over used {min(ratios):.2f} to '
            f'{max(ratios):.2f}, within a factor of 2.5 in {sum(.4 <= ratio <= 2.5 for ratio in ratios)}')


def tell(row):
    """Prints what is known of a site; false where that is why nothing is."""
    said = f"forecast {row['forecast']:.2f}, {row['blocks']} blocks; {row['said_s']:.0f} s said" if 'blocks' in row else ''
    if 'cpu_s' in row:
        said += f", {row['cpu_s']:.1f} s used; moved {row['moved']:.2f}; {kind(row['forecast'])}, {kind(row['moved'])}"
    print(row['site'] + ': ' + '; '.join(part for part in (said, row.get('why_not')) if part), flush=True)
    return 'why_not' not in row


def write_table(rows, out):
    with open(os.path.join(out, 'sites.csv'), 'w', encoding='utf-8', newline='') as file:
        table = csv.DictWriter(file, ['site', 'blocks', 'forecast', 'moved', 'said_s', 'cpu_s'], extrasaction='ignore')
        table.writeheader()
        table.writerows(rows)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('out')
    parser.add_argument('folders', nargs='*')
    parser.add_argument('--bin', default='')
    parser.add_argument('--drawn', type=int, default=10)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--duration', type=float, default=0)
    parser.add_argument('--most-s', type=float, default=math.inf)
    parser.add_argument('--jobs', type=int, default=1)
    options = parser.parse_intermixed_args()
    if not options.folders and not os.path.isdir(f'{root}/../shared/data'):
        sys.exit('skipped: no ../shared/data')
    options.out = os.path.abspath(options.out)
    sites = os.path.join(options.out, 'sites')
    os.makedirs(sites, exist_ok=True)
    folders = options.folders or [forecast_sites.serles(sites)] + [f'{root}/sample_sites/{name}' for name in shared]
    draw = forecast_sites.drawn(sites, options.seed)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        look = lambda batch: [row for row in pool.map(lambda folder: looked_at(folder, options), batch) if tell(row)]
        looks = []
        while not options.folders and len(looks) < options.drawn:
            looks += look([next(draw) for _ in range(options.drawn - len(looks))])
        looks += look(folders)
        looks.sort(key=lambda row: row['said_s'])
        rows = []
        for row in pool.map(lambda row: run(row, options), looks):
            if tell(row):
                rows.append(row)
                write_table(rows, options.out)
    print(summary(rows) if rows else 'no site was run')


main()
