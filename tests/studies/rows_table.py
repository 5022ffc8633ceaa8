#!/usr/bin/env python3
"""Table of the closed forms in docs/verification.md, from a table of talus-verify.

    talus-verify -o DIR --full
    python3 tests/studies/rows_table.py DIR/verify.csv...

A line a case: error, and in brackets the CPU time in ms, of both laws at several time steps each, at
the defaults of law talus and at k_n = 5e10 N/m of law paper. "lost": no answer, a block went through
the ground, left it, or was nowhere.
"""
import csv
import sys

ROWS = [
    (1, ["parabola"]),
    (2, ["slide_0", "slide_5", "slide_10", "slide_15", "slide_20", "slide_25", "slide_29"]),
    (3, ["stick", "slide_29.9"]),
    (4, ["rolling"]),
    (5, ["sustained_rolling"]),
    (6, ["bounce_face", "bounce_edge", "bounce_corner", "bounce_soft", "bounce_elastic"]),
    (7, ["free_spin"]),
    (8, ["wedge", "wedge_critical"]),
    (9, ["toppling", "column_slides"]),
    (10, ["rocking", "rocking_ratio"]),
    (11, ["shaken"]),
    (12, ["corner_impulse"]),
    (13, ["energy_line"]),
    (14, ["own_weight"]),
    (15, ["elastic_cor"]),
    (16, ["oblique"]),
    (17, ["tumbling"]),
    ("cohesion", ["bond"]),
    ("ghosts", ["ghost"]),
    ("blocks", ["tower_slide", "tower_holds", "pile_topples", "block_on_block", "groove", "head_on",
                "collision", "dominoes", "stack_10", "arch", "large_on_small", "thin_plate"]),
    ("slide", ["slide39_centre", "slide39_p90", "slide39_spread"]),
]
PAPER_STIFFNESS = 5e10


TALUS_DT = (5e-2, 1e-2, 5e-3, 1e-3)
PAPER_DT = (1e-2, 1e-3, 1e-4)


def text(number):
    if number == "nan":
        return "lost"
    if float(number) == 0:
        return "0"
    return f"{float(number):.1e}".replace("e-0", "e-").replace("e+0", "e").replace("e0", "")


def chosen(lines, law):
    """Of one case and law: steps, longest first, at its usual stiffness and without strains."""
    lines = [x for x in lines if x["law"] == law and float(x["solver_tolerance"]) == 1]
    wanted = PAPER_STIFFNESS if law == "paper" else 0
    lines = [x for x in lines if float(x["normal_stiffness_n_m"]) == wanted]
    if not lines:
        return []
    dof = min(int(x["dof"]) for x in lines)
    lines = [x for x in lines if int(x["dof"]) == dof]
    return sorted(lines, key=lambda x: -float(x["dt_s"]))


def cell(lines, dt):
    for x in lines:
        if abs(float(x["dt_s"]) - dt) < 1e-9:
            return f"{text(x['error'])} ({1e3 * float(x['cpu_time_s']):.3g})"
    return "-"


def main():
    lines = []
    for name in sys.argv[1:]:
        with open(name, newline="", encoding="utf-8") as file:
            lines += csv.DictReader(file)
    print("| Row | Case | Error is | talus, " + " | ".join(f"{dt:g}" for dt in TALUS_DT) +
          " | paper, " + " | ".join(f"{dt:g}" for dt in PAPER_DT) + " |")
    print("|---" * (3 + len(TALUS_DT) + len(PAPER_DT)) + "|")
    for row, names in ROWS:
        for name in names:
            case = [x for x in lines if x["case"] == name]
            if not case:
                sys.exit(f"no table has the case {name}")
            talus, paper = chosen(case, "talus"), chosen(case, "paper")
            cells = [cell(talus, dt) for dt in TALUS_DT]
            cells += [cell(paper, dt) for dt in PAPER_DT]
            print(f"| {row} | `{name}` | {case[0]['error_norm']} | " + " | ".join(cells) + " |")


main()
