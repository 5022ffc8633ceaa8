#!/usr/bin/env python3
"""Checks that every path which docs/developing/developing.md names in `code` exists, that its table of modules is
that of check_includes.py, and that its nine stages are those of docs/theory/theory.md."""
import pathlib
import re
import sys

from check_includes import MODULES

PATH = re.compile(r"`((?:libcore|verify|tools|tests|docs|pipelines)(?:/[\w.-]+)*)`")
STAGE = re.compile(r"^\| (\d+) \| `(\w+)`", re.MULTILINE)


def problems_of(root):
    text = (root / "docs/developing/developing.md").read_text()
    paths = PATH.findall(text)
    for path in paths:
        if "NAME" not in path and not (root / path).exists():
            yield f"docs/developing/developing.md names {path}: no such file or folder"
    named = [m for m in re.findall(r"^\| `libcore/(\w+)` \|", text, re.MULTILINE)]
    if named != [m for m in MODULES if m != "verify"]:
        yield f"docs/developing/developing.md: modules {named}, check_includes.py has {MODULES}"
    here, there = STAGE.findall(text), STAGE.findall((root / "docs/theory/theory.md").read_text())
    if not here or here != there:
        yield f"stages of an island: docs/developing/developing.md has {here}, docs/theory/theory.md {there}"


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1])))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
