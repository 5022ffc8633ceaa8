#!/usr/bin/env python3
"""Checks that every path which docs/developing/developing.md and docs/theory/theory.md name in `code` exists (those of
theory.md below libcore), and that the table of modules is that of check_includes.py."""
import pathlib
import re
import sys

from check_includes import MODULES

PATH = re.compile(r"`((?:libcore|verify|tools|tests|docs|pipelines)(?:/[\w.-]+)*)`")
SOURCE = re.compile(r"`((?:\w+/)+\w+\.[ch]pp)`")


def problems_of(root):
    text = (root / "docs/developing/developing.md").read_text()
    for path in PATH.findall(text):
        if "NAME" not in path and not (root / path).exists():
            yield f"docs/developing/developing.md names {path}: no such file or folder"
    sources = SOURCE.findall((root / "docs/theory/theory.md").read_text())
    if not sources:
        yield "docs/theory/theory.md names no source"
    for path in sources:
        if not (root / "libcore" / path).exists():
            yield f"docs/theory/theory.md names {path}: no such file in libcore"
    named = [m for m in re.findall(r"^\| `libcore/(\w+)` \|", text, re.MULTILINE)]
    if named != [m for m in MODULES if m != "verify"]:
        yield f"docs/developing/developing.md: modules {named}, check_includes.py has {MODULES}"


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1])))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
