#!/usr/bin/env python3
"""Mobility of simulated events beside published relations (share/mobility.csv): H/L and L.

The events are the runs that designed_slide.py and real_sites.py left beside this study's folder. First volume, H and L
of the event (chord from the top of the source to the toe), of its centre of mass beside the friction; then L95 over
the expectation of each relation, and its percentile in the relation's scatter where most of the mass left its source.
Relations from memory and those of debris flows are left out.
"""
import json
import statistics

from study import Study, skip

RELATIONS = ("corominas_rockfall_all", "corominas_rockfall_unobstructed", "corominas_rockfall_obstructed",
             "corominas_slide_all", "mitchell_length", "mitchell_hl")
EVENTS = {"designed": ("designed_slide/talus_0.005", 25),  # folder, friction [degrees]
          **{site: (f"real_sites/{site}", 32) for site in
             ("gschnitz_gar", "lechtal_kotcliff", "lechtal_kotdam", "salisbury_crags")}}

STUDY = Study(__file__, __doc__)


def of(relation, key):
    values = [run[key] for run in relation["runs"] if run[key] is not None]
    return statistics.mean(values) if values else float("nan")


@STUDY.part("all", 60)
def compute(study):
    results = {}
    for name, (place, friction_deg) in EVENTS.items():
        folder = study.out.parent / place
        runs = sorted(folder.glob("runs/run_*.h5"))
        made_by = study.out.parent / place.partition("/")[0] / "commit"
        if not runs or made_by.read_text() != study.commit:
            skip(f"no runs of {study.commit} in {folder}: designed_slide.py and real_sites.py make them")
        said = study.run("talus-runout", *runs, "--trn", folder / "bed.tif", "-o", f"{name}.gpkg", "--overwrite", "--json",
                         "--no-db", "-q", codes=(0, 3))
        results[name] = json.loads(said)
        event = [run["event"] for run in results[name]["runs"]]
        mean = lambda pick: statistics.mean(pick(e) for e in event)
        study.row("events", name, {
            "runs": len(event), "V [m3]": f"{results[name]['balance']['released_m3'] / len(event):.0f}",
            "H [m]": f"{mean(lambda e: e['H_m']):.0f}", "L [m]": f"{mean(lambda e: e['L_chord_m']):.0f}",
            "H/L": f"{mean(lambda e: e['H_m'] / e['L_chord_m']):.2f}",
            "H/L of the centre": f"{statistics.mean(r['centre_of_mass']['H_over_L'] for r in results[name]['runs']):.2f}",
            "friction [degrees]": friction_deg})
    for name in RELATIONS:
        of_name = {event: next(r for r in result["mobility"] if r["relation"] == name) for event, result in results.items()}
        percentile = {event: of(relation, "percentile") for event, relation in of_name.items()}
        study.row("relations", name, {event: f"{of(relation, 'L_over_expected'):.2f}" +
                                      (f" ({percentile[event]:.0f})" if percentile[event] == percentile[event] else "")
                                      for event, relation in of_name.items()})


if __name__ == "__main__":
    STUDY.main()
