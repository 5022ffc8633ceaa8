#!/usr/bin/env python3
"""Single rocks on the four sites of real_sites.py, from contours to fence, each site beside its scenario.

Rocks of 0.3 m3 on a grid over the release polygon, a hundred to its area in plan, each as if alone, 80 s, without
rolling resistance.
"""
from real_sites import SITES, evaluate, write_rock_site
from study import Study

STUDY = Study(__file__, __doc__)


def compute(study, site):
    write_rock_site(study, site, study.out / site, 100, "joints|source", "\n[solver]\nduration_s = 80\nmax_lost_share = 1\n")
    evaluate(study, site, study.out / site, study.out / site / "out", "RUNS=1")


for one in SITES:
    STUDY.part(one, 10)(lambda study, site=one: compute(study, site))

if __name__ == "__main__":
    STUDY.main()
