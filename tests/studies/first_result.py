#!/usr/bin/env python3
"""How long the first result takes in a bare Debian 12 (tests/clean_machine.sh): needs root and debootstrap."""
import os
import re
import shutil

from study import SOURCE, Study, skip

STUDY = Study(__file__, __doc__)


STEPS = ("demo, from nothing", "demo again, the site computed anew", "build and all tests")


@STUDY.part("all", 2000)
def compute(study):
    if os.geteuid() or not shutil.which("debootstrap"):
        skip("needs root and debootstrap")
    said = study.run("sh", SOURCE / "tests/clean_machine.sh")
    for name, (clock, used) in zip(STEPS, re.findall(r"^cd /talus && .*: (\d+) s, (\d+) s of processor time$", said, re.M)):
        study.row("steps", name, {"by the clock [s]": clock, "CPU s": used})


if __name__ == "__main__":
    STUDY.main()
