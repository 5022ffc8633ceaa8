#!/usr/bin/env python3
"""Forecasts of talus-check beside results of runs: the share of the mass that moves, and the time.

All sites are looked at first (`make check`); then each gets one run of 30 s, the cheapest first. The share of the mass
that the probe sees moving is compared with the share that moved more than 1 m by the end; the time that the check
says for this machine beside the processor time of talus-dda. Sites: the four shared slopes, a slope of the Serles and
ten drawn at random (forecast_sites.py). Drawn sites that offer no mass (refused by the check, or no plane daylights)
are named and replaced by the next ones drawn.
"""
import json
import os
import re
import subprocess

import forecast_sites
from study import SOURCE, Study

SHARED = ('gschnitz_gar', 'lechtal_kotcliff', 'lechtal_kotdam', 'salisbury_crags')
DRAWN, SEED, DURATION_S = 10, 11, 30


def kind(share):
    return 'stands' if share < .1 else 'goes' if share > .9 else 'goes in part'


def seconds_said(words):
    number, unit = re.search(r'a run takes about ([\d.]+) (s|min|h) of one core', words).groups()
    return float(number) * {'s': 1, 'min': 60, 'h': 3600}[unit]


def make(study, folder, out, goals, log):
    duration = f'--set solver.duration_s={DURATION_S}'
    command = ['make', '-C', folder, f'BIN={study.bin}/', f'OUT={out}', 'RUNS=1', 'WITHOUT=no', f'CHECK_FLAGS={duration}',
               f'DDA_FLAGS=--json {duration}', *goals]
    with open(log, 'w', encoding='utf-8') as file:
        return subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, check=False).returncode


def first_message(log):
    with open(log, encoding='utf-8') as lines:
        return next((line.strip() for line in lines if re.match(r'talus-\w+: (?!warning)', line)), f'see {log}')[:160]


def looked_at(study, folder):
    """Forecast of the check for a site, or why it is missing."""
    name = os.path.basename(folder)
    out, log = study.out / name, study.out / f'{name}.check.log'
    row = {'site': name, 'folder': folder}
    if not (out / 'check.json').exists() and make(study, folder, out, ['check'], log) != 0:
        return {**row, 'why_not': first_message(log)}
    check = json.loads((out / 'check.json').read_text())
    if any(doubt['state'] == 'refused' for doubt in check['doubts']) or 'probe' not in check:
        return {**row, 'why_not': first_message(log)}
    return {**row, 'blocks': check['n_blocks'], 'forecast': check['probe']['moved_share'], 'said_s': seconds_said(log.read_text())}


def run(study, row):
    """The same row with the results of a run of the site."""
    out, log = study.out / row['site'], study.out / f"{row['site']}.run.log"
    if not (out / 'runout.json').exists():
        make(study, row['folder'], out, ['runs', 'runout'], log)
    runout = json.loads((out / 'runout.json').read_text())
    cpu = float(re.search(r'"cpu_time_s":\s*([\d.e+-]+)', log.read_text()).group(1))
    return {**row, 'moved': runout['moved']['share_moved_1_m'], 'cpu_s': cpu}


STUDY = Study(__file__, __doc__)


@STUDY.part('all', 500)
def compute(study):
    study.need_data('dem', 'scenarios')
    sites = str(study.out / 'sites')
    draw, looks = forecast_sites.drawn(sites, SEED), []
    folders = [forecast_sites.serles(sites)] + [f'{SOURCE}/sample_sites/{name}' for name in SHARED]
    while folders or len(looks) < DRAWN + 1 + len(SHARED):
        looked = looked_at(study, folders.pop() if folders else next(draw))
        if 'why_not' in looked:
            print(f"{looked['site']}: {looked['why_not']}", flush=True)
        else:
            looks.append(looked)
    rows = [run(study, row) for row in sorted(looks, key=lambda row: row['said_s'])]
    for row in rows:
        study.row('sites', row['site'], {'blocks': row['blocks'], 'forecast': f"{row['forecast']:.2f}", 'moved': f"{row['moved']:.2f}",
                                         'time said [s]': f"{row['said_s']:.0f}", 'used [s]': f"{row['cpu_s']:.1f}"})
    off = [row['forecast'] - row['moved'] for row in rows]
    # A run of less than a second is said to take one.
    ratios = [row['said_s'] / max(1, row['cpu_s']) for row in rows]
    study.row('summary', 'all', {
        'sites': len(rows), 'share, rms': f'{(sum(d * d for d in off) / len(off)) ** .5:.3f}', 'worst': f'{max(off, key=abs):+.2f}',
        'class right': sum(kind(row['forecast']) == kind(row['moved']) for row in rows),
        'time said over used': (f'{sum(ratios) / len(ratios):.2f}', f'{min(ratios):.2f}', f'{max(ratios):.2f}'),
        'within a factor of 2.5': sum(.4 <= ratio <= 2.5 for ratio in ratios)})


if __name__ == '__main__':
    STUDY.main()
