#!/usr/bin/env python3
"""Faults of the machine: the long form of tests/endurance, with the tools that it builds. See tests/endurance/run.sh."""
from study import SOURCE, Study

STUDY = Study(__file__, __doc__)


@STUDY.part("all", 5000)
def compute(study):
    rows = SOURCE / "build/endurance.rows"
    rows.unlink(missing_ok=True)
    study.run("sh", SOURCE / "tests/endurance/run.sh", "long", codes=(0, 1))
    tried_of_all = survived_of_all = 0
    for line in rows.read_text(encoding="utf-8").splitlines():
        fault, tried, survived, _, note, commit = line.split("\t")
        if commit != study.commit:
            raise SystemExit(f"the tools of the endurance tests are of {commit}, expected {study.commit}")
        study.row("faults", fault, {"tried": tried, "survived": survived, "note": note})
        tried_of_all, survived_of_all = tried_of_all + int(tried), survived_of_all + int(survived)
    study.row("all", "all", {"tried": tried_of_all, "survived": survived_of_all})


if __name__ == "__main__":
    STUDY.main()
