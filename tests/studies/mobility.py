#!/usr/bin/env python3
"""Mobility of simulated events beside published relations (share/mobility.csv): H/L and L.

  python3 tests/studies/mobility.py BIN NAME=FOLDER[:FRICTION_DEG]...

FOLDER holds runs/run_*.h5 (or run_*.h5) and bed.tif, as the pipeline leaves them. Prints the table of
docs/verification.md: volume, H and L of the event (chord from the top of the source to the toe), of its
centre of mass beside tan(friction), L over what each relation expects, and the chance that it is exceeded
where the relation has a scatter. Relations from memory are left out.
"""
import json
import statistics
import subprocess
import sys
from pathlib import Path

RELATIONS = ("corominas_rockfall_all", "corominas_slide_all", "mitchell_length", "mitchell_hl")


def runout(tools, folder):
    runs = sorted(folder.glob("runs/run_*.h5")) or sorted(folder.glob("run_*.h5"))
    done = subprocess.run([tools / "talus-runout", *runs, "--trn", folder / "bed.tif", "-o",
                           folder / "mobility.gpkg", "--json", "--allow-unfinished", "--no-db", "--overwrite", "-q"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def of(relation, key):
    values = [run[key] for run in relation["runs"] if run[key] is not None]
    return statistics.mean(values) if values else float("nan")


def row(name, result, friction_deg):
    event = [run["event"] for run in result["runs"]]
    mean = lambda pick: statistics.mean(pick(e) for e in event)
    words = [name, f"{len(event)}", f"{result['balance']['released_m3'] / len(event):.0f}",
             f"{mean(lambda e: e['H_m']):.0f}", f"{mean(lambda e: e['L_chord_m']):.0f}"]
    words.append(f"{mean(lambda e: e['H_m'] / e['L_chord_m']):.2f}")
    words.append(f"{statistics.mean(r['centre_of_mass']['H_over_L'] for r in result['runs']):.2f}, {friction_deg}")
    for relation in result["mobility"]:
        if relation["relation"] in RELATIONS:
            chance = of(relation, "exceedance_probability")
            words.append(f"{of(relation, 'L_over_expected'):.2f}" + ("" if chance != chance else f" ({100 * chance:.0f} %)"))
    return "| " + " | ".join(words) + " |"


def main():
    tools = Path(sys.argv[1]).resolve()
    print("| Event | runs | V m3 | H m | L m | H/L | H_cm/L_cm, friction deg | L over "
          + " | over ".join(RELATIONS) + " |\n|" + "---|" * (7 + len(RELATIONS)))
    for word in sys.argv[2:]:
        name, place = word.split("=", 1)
        folder, _, friction = place.partition(":")
        print(row(name, runout(tools, Path(folder)), friction or "-"))


if __name__ == "__main__":
    main()
