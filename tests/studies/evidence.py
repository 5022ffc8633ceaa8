#!/usr/bin/env python3
"""The evidence of one commit: runs the studies, and makes the pages of docs/evidence from their results.

  python3 tests/studies/evidence.py list                                  studies, CPU seconds, commits
  python3 tests/studies/evidence.py run [--bin FOLDER] [--out FOLDER] [STUDY]...
  python3 tests/studies/evidence.py pages                                 writes the pages
  python3 tests/studies/evidence.py check                                 fails where a page is not as the files say

`run` writes the results of each study to docs/evidence/data/STUDY.csv and writes the pages. It leaves out results of
the same commit that exist, so it can be stopped and resumed. `list` says what each costs; two halves (names of
studies) can be run side by side.

A page is PAGE.md.in with these marks filled:

  {{table STUDY.TABLE | first column | quantity, ...}}   a table, with all quantities where none is named
  {{STUDY.TABLE/ROW/QUANTITY}}                           a value; ROW *: the least and the largest of all rows
  {{interval STUDY.TABLE/ROW/QUANTITY}}                  its interval
  {{sum STUDY.TABLE/*/QUANTITY}}                         the sum of all rows
  {{holds STUDY.TABLE/ROW/QUANTITY <= 5}}                "holds" or "**does not hold**"; ROW *: of every row
  {{made STUDY}}                                         the command, the commit and the date
  {{commits}}                                            the commit of all, and which files are older

Files of two commits make no page. A file with a line "# old: WHY" is let through, and every page names it, until the
study is run again.
"""
import argparse
import operator
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import study

EVIDENCE = study.SOURCE / "docs/evidence"
# In the order of a run: some read files that earlier ones left in OUT.
STUDIES = ["deliveries", "terrain_error", "field", "columns", "calibrate", "two_bounds", "fence_search", "forecast",
           "designed_slide", "real_sites", "single_rocks", "mobility", "error_budget", "rocks_beside_ode", "beside_ode",
           "benchmarks", "speed", "verification", "faults", "first_result"]
COMPARE = {"<=": operator.le, ">=": operator.ge, "<": operator.lt, ">": operator.gt, "==": operator.eq}


class Fault(Exception):
    """Fault that makes a page impossible."""


class Data:
    """All files of a folder of evidence."""

    def __init__(self, folder):
        self.heads, self.rows = {}, {}
        for path in sorted(folder.glob("*.csv")):
            self.heads[path.stem], self.rows[path.stem] = study.read(path)
        self.new = {head["commit"]: name for name, head in self.heads.items() if "old" not in head}
        if len(self.new) > 1:
            raise Fault("files of several commits make no page: " +
                        ", ".join(f"{name}.csv is of {commit}" for commit, name in self.new.items()) +
                        "; run the studies again (evidence.py run) with tools of one commit")

    def table(self, place):
        name, _, table = place.partition(".")
        rows = [row for row in self.rows.get(name, ()) if row["table"] == table]
        if not rows:
            raise Fault(f"there is no table {place} in docs/evidence/data")
        return rows

    def values(self, place):
        table, row, quantity = (place.split("/", 2) + ["", ""])[:3]
        found = [one for one in self.table(table) if one["quantity"] == quantity and row in ("*", one["row"])]
        if not found:
            raise Fault(f"there is no value {place}")
        return found

    def head(self, name):
        if name not in self.heads:
            raise Fault(f"there is no docs/evidence/data/{name}.csv")
        return self.heads[name]


def number(text):
    try:
        return float(text.replace(",", ""))
    except ValueError as error:
        raise Fault(f'"{text}" is no number') from error


def filled(data, mark):
    kind, _, rest = mark.partition(" ")
    if kind == "table":
        place, first, quantities = ([part.strip() for part in rest.split("|")] + ["", ""])[:3]
        return study.as_table(data.table(place), first, [one.strip() for one in quantities.split(",")] if quantities else None)
    if kind == "interval":
        one, = data.values(rest)
        return f"{one['low']} to {one['high']}"
    if kind == "sum":
        return f"{sum(number(one['value']) for one in data.values(rest)):,.0f}"
    if kind == "holds":
        place, sign, bound = re.fullmatch(r"(.*) (<=|>=|<|>|==) (\S+)", rest).groups()
        good = all(COMPARE[sign](number(one["value"]), float(bound)) for one in data.values(place))
        return "holds" if good else "**does not hold**"
    if kind == "made":
        head = data.head(rest)
        return f"`{head['command']}` ({head['commit'][:8]}, {head['date']}{'; older, ' + head['old'] if 'old' in head else ''})"
    if kind == "commits":
        said = f"All numbers are of commit {next(iter(data.new))[:8]}" if data.new else "No number is of this commit"
        old = [f"{name} ({head['commit'][:8]})" for name, head in data.heads.items() if "old" in head]
        return said + (f", but for older ones that wait to be measured again: {', '.join(old)}." if old else ".")
    found = [one["value"] for one in data.values(mark)]
    if len(set(found)) == 1:
        return found[0]
    return f"{min(found, key=number)} to {max(found, key=number)}"


def wrapped(paragraph):
    """Lines of a paragraph within 100 columns; headings and code stay."""
    if paragraph.startswith("#"):
        heading, _, rest = paragraph.partition("\n")
        return heading + "\n" + wrapped(rest) if rest else heading
    if re.match("`{3}|    ", paragraph):
        return paragraph
    items = re.split(r"\n(?=- )", paragraph)
    return "\n".join(textwrap.fill(" ".join(item.split()), 100, break_long_words=False, break_on_hyphens=False,
                                   subsequent_indent="  " if item.startswith("- ") else "") for item in items)


def page(data, template):
    """The page of a template."""
    whole = []
    for paragraph in template.split("\n\n"):
        made = re.sub(r"\{\{(.+?)\}\}", lambda mark: filled(data, mark.group(1)), paragraph)
        whole.append(wrapped(made) if "\n|" not in "\n" + made else made)
    return "\n\n".join(whole).rstrip("\n") + "\n"


def pages(folder):
    """Paths and texts of all pages."""
    data = Data(folder / "data")
    made, used = {}, set()
    for template in sorted(folder.glob("*.md.in")):
        text = template.read_text(encoding="utf-8")
        used |= set(re.findall(r"\{\{(?:\w+ )?([\w]+)[.} ]", text))
        try:
            made[template.with_suffix("")] = page(data, text)
        except Fault as fault:
            raise Fault(f"{template.name}: {fault}") from fault
    for name in data.heads:
        if name not in used:
            raise Fault(f"data/{name}.csv is on no page: take it out, or name it in a page")
    return made


def check(folder):
    faults = [f"{path.name} is not what docs/evidence/data says: python3 tests/studies/evidence.py pages"
              for path, text in pages(folder).items() if not path.exists() or path.read_text(encoding="utf-8") != text]
    heads = Data(folder / "data").heads
    if "verification" in heads and f"Commit {heads['verification']['commit']} " not in (folder / "verification.md").read_text(encoding="utf-8"):
        faults.append("verification.md is of another commit than data/verification.csv")
    for name, head in heads.items():
        script = re.search(r"(?:tests|sample_sites|pipelines)/[\w/.]+", head["command"])
        if script and not (study.SOURCE / script.group()).exists():
            faults.append(f"data/{name}.csv: its command is gone: {head['command']}")
    return faults


def python():
    """A Python that has the packages of the studies."""
    for program in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([program, "-c", "import h5py, numpy; from osgeo import gdal"], capture_output=True, check=False).returncode == 0:
            return program
    sys.exit("no python3 with GDAL, numpy and h5py: install python3-gdal, python3-numpy and python3-h5py")


def listed():
    total, program = 0, python()
    for name in STUDIES:
        said = subprocess.run([program, study.SOURCE / f"tests/studies/{name}.py", "--list"], capture_output=True, text=True, check=True).stdout
        cost = sum(int(line.split()[0]) for line in said.splitlines())
        total += cost
        path = EVIDENCE / f"data/{name}.csv"
        head = study.read(path)[0] if path.exists() else {}
        print(f"{cost:6d} s  {name:18} {head.get('commit', '-')[:8]} {'old' if 'old' in head else ''}")
    print(f"{total:6d} s, {total / 3600:.1f} h of one core")


def run(options):
    program, wrong = python(), []
    commit = study.commit_of(options.bin.resolve())
    if not study.is_clean(commit):
        raise Fault(f"the tools in {options.bin} are of {commit}, expected a commit: build them of a clean checkout")
    for name in options.studies or STUDIES:
        out, target = options.out.resolve() / name, EVIDENCE / f"data/{name}.csv"
        if target.exists():
            head = study.read(target)[0]
            if "old" not in head and head["commit"] == commit:
                print(f"{name}: is there")
                continue
        print(f"{name}: begins", flush=True)
        code = subprocess.run([program, study.SOURCE / f"tests/studies/{name}.py", "--bin", options.bin, "--out", out], check=False).returncode
        if code:
            wrong.append(f"{name} ended with {code}")
        elif (out / f"{name}.csv").exists():
            shutil.copy(out / f"{name}.csv", target)
    for path, text in pages(EVIDENCE).items():
        path.write_text(text, encoding="utf-8")
    return wrong


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("what", choices=["list", "run", "pages", "check"])
    words.add_argument("studies", nargs="*", metavar="STUDY", help="those to run; else all")
    words.add_argument("--bin", type=Path, default=study.SOURCE / "build/release/tools", help="folder of the tools")
    words.add_argument("--out", type=Path, default=study.SOURCE / "build/evidence", help="what the studies keep")
    words.add_argument("--evidence", type=Path, default=EVIDENCE, help="folder of pages and data to check")
    options = words.parse_intermixed_args()
    try:
        if options.what == "list":
            return listed()
        if options.what == "check":
            wrong = check(options.evidence)
        elif options.what == "run":
            wrong = run(options)
        else:
            wrong = []
            for path, text in pages(EVIDENCE).items():
                path.write_text(text, encoding="utf-8")
    except Fault as fault:
        wrong = [str(fault)]
    print("\n".join(wrong) if wrong else "the pages are what docs/evidence/data says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
