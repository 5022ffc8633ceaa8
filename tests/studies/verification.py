#!/usr/bin/env python3
"""The full study of talus-verify: writes docs/evidence/verification.md and its diagrams, and counts cases that hold.

With ../shared/peers other engines are in the diagrams.
"""
import re

from study import SOURCE, Study

STUDY = Study(__file__, __doc__)


@STUDY.part("all", 2000)
def compute(study):
    folder, peers = SOURCE / "docs/evidence", SOURCE.parent / "shared/peers"
    study.run("talus-verify", "--full", "--stability", "--leaving-out", *(["--peers", peers] if peers.exists() else []),
              "-o", folder / "verification", "--page", folder / "verification.md", "--overwrite", "--no-db", "-q", codes=(0, 3))
    page = (folder / "verification.md").read_text(encoding="utf-8")
    held, n = re.search(r"(\d+) of (\d+) cases? within", page).groups()
    right, inexact = re.search(r"(\d+) right, (\d+) inexact", page).groups()
    study.row("counts", "full study", {"cases": n, "within their bounds": held, "corners right": right, "inexact": inexact})


if __name__ == "__main__":
    STUDY.main()
