#!/usr/bin/env python3
"""Mobility of simulated events beside published relations (share/mobility.csv): H/L and L.

  python3 tests/studies/mobility.py BIN NAME=FOLDER[:FRICTION_DEG]...

FOLDER holds runs/run_*.h5 (or run_*.h5) and bed.tif, as the pipeline leaves them. Prints the table of
docs/evidence/validation.md: volume, H and L of the event (chord from the top of the source to the toe), of its
centre of mass beside tan(friction); then a line a relation: L95 over what it expects, and its percentile in the
relation's scatter where most of the mass left its source.
Relations from memory and those of debris flows are left out.
"""
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

RELATIONS = ("corominas_rockfall_all", "corominas_rockfall_unobstructed", "corominas_rockfall_obstructed",
             "corominas_rockfall_deflected", "corominas_slide_all", "corominas_slide_unobstructed",
             "corominas_slide_obstructed", "mitchell_length", "mitchell_hl")


def runout(tools, folder):
    runs = sorted(folder.glob("runs/run_*.h5")) or sorted(folder.glob("run_*.h5"))
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run([tools / "talus-runout", *runs, "--trn", folder / "bed.tif", "-o",
                               scratch + "/runout.gpkg", "--json", "--no-db", "-q"],
                              capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def of(relation, key):
    values = [run[key] for run in relation["runs"] if run[key] is not None]
    return statistics.mean(values) if values else float("nan")


def event_row(name, result, friction_deg):
    event = [run["event"] for run in result["runs"]]
    mean = lambda pick: statistics.mean(pick(e) for e in event)
    words = [name, f"{len(event)}", f"{result['balance']['released_m3'] / len(event):.0f}",
             f"{mean(lambda e: e['H_m']):.0f}", f"{mean(lambda e: e['L_chord_m']):.0f}"]
    words.append(f"{mean(lambda e: e['H_m'] / e['L_chord_m']):.2f}")
    words.append(f"{statistics.mean(r['centre_of_mass']['H_over_L'] for r in result['runs']):.2f}, {friction_deg}")
    return words


def relation_cell(result, name):
    relation = next(r for r in result["mobility"] if r["relation"] == name)
    percentile = of(relation, "percentile")
    return f"{of(relation, 'L_over_expected'):.2f}" + (f" ({percentile:.0f})" if percentile == percentile else "")


def line(words):
    print("| " + " | ".join(words) + " |")


def main():
    tools = Path(sys.argv[1]).resolve()
    results = {}
    for word in sys.argv[2:]:
        name, place = word.split("=", 1)
        folder, _, friction = place.partition(":")
        results[name] = (runout(tools, Path(folder)), friction or "-")
    line(["Event", "runs", "V m3", "H m", "L m", "H/L", "H_cm/L_cm, friction deg"])
    print("|" + "---|" * 7)
    for name, (result, friction) in results.items():
        line(event_row(name, result, friction))
    print()
    line(["L over", *results])
    print("|" + "---|" * (1 + len(results)))
    for relation in RELATIONS:
        line([relation, *(relation_cell(result, relation) for result, _ in results.values())])


if __name__ == "__main__":
    main()
