"""Common code of the studies: parts that know their cost, one command line, and the CSV file of results.

A study is a script that makes a Study, names its parts and ends with `study.main()`:

  python3 tests/studies/NAME.py [--bin FOLDER] [--out FOLDER] [--data FOLDER] [--only PART]... [--list]

The result of a part is kept in OUT/parts and not computed again by tools of the same commit with the same options, so
a study can be ended and begun anew at any time. When all parts are there, OUT/NAME.csv is written and printed as
tables. evidence.py takes the file to docs/evidence/data and makes the pages.

The file begins with lines "# KEY: VALUE" (command, commit of the tools, date, machine, cpu_s), then has a row a value:
table, row, quantity, value, low, high, unit. `low` and `high` are an interval or a range, as the page says.
"""
import argparse
import csv
import datetime
import io
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
COLUMNS = ["table", "row", "quantity", "value", "low", "high", "unit"]
SKIPPED = 77  # exit code where data or programs are missing


def skip(why):
    print(f"skipped: {why}", file=sys.stderr)
    sys.exit(SKIPPED)


def commit_of(tools):
    """The commit that tools were built of; it ends with -dirty where sources were changed."""
    said = subprocess.run([tools / "talus-runs", "--version"], check=True, capture_output=True, text=True).stdout
    return re.search(r"\((\S+)\)", said).group(1)


def is_clean(commit):
    return re.fullmatch("[0-9a-f]{7,40}", commit) is not None


def machine():
    return next((line.partition(":")[2].strip() for line in open("/proc/cpuinfo", encoding="utf-8")
                 if line.startswith("model name")), "unknown")


def cpu_s():
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def write(path, head, rows):
    """Keys of the head, then rows of COLUMNS."""
    text = io.StringIO()
    text.writelines(f"# {key}: {value}\n" for key, value in head.items())
    csv.writer(text, lineterminator="\n").writerows([COLUMNS, *rows])
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text.getvalue(), encoding="utf-8")


def read(path):
    """Head and rows as `write` wrote them."""
    lines = path.read_text(encoding="utf-8").splitlines()
    head = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    return head, list(csv.DictReader(line for line in lines if not line.startswith("# ")))


def shown(row):
    return row["value"] + (f" ({row['low']} to {row['high']})" if row["low"] else "")


def as_table(rows, first, quantities=None):
    """A Markdown table of the rows of one table, a line a row, a column a quantity."""
    cells = {(row["row"], row["quantity"]): shown(row) for row in rows}
    units = {row["quantity"]: row["unit"] for row in rows}
    columns = quantities or list(units)
    lines = [[first, *(name + (f" [{units[name]}]" if units[name] else "") for name in columns)], ["---"] * (1 + len(columns))]
    lines += [[name, *(cells.get((name, column), "") for column in columns)] for name in dict.fromkeys(row["row"] for row in rows)]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines).replace("| --- ", "|---").replace("|--- |", "|---|")


class Study:
    """The parts of a script, and the options of its command line."""

    def __init__(self, script, doc):
        self.name, self.parts, self.rows = Path(script).stem, [], []
        self.words = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
        self.words.add_argument("--bin", type=Path, default=SOURCE / "build/release/tools", help="folder of the tools")
        self.words.add_argument("--out", type=Path, default=SOURCE / "build/evidence" / self.name, help="kept results")
        self.words.add_argument("--data", type=Path, default=SOURCE / "../shared/data", help="folder of the data")
        self.words.add_argument("--only", action="append", default=[], metavar="PART")
        self.words.add_argument("--list", action="store_true", help="print the parts and their CPU seconds, and end")
        self.shared = {action.dest for action in self.words._actions}

    def part(self, name, cost_s):
        """The function that follows computes this part, in some `cost_s` CPU seconds."""
        def add(compute):
            self.parts.append((name, cost_s, compute))
            return compute
        return add

    def row(self, table, row, quantities):
        """Values of a row by "quantity [unit]"; a value is text, a number, or (value, low, high)."""
        for title, value in quantities.items():
            name, unit = re.fullmatch(r"(.*?)(?: \[(.*)\])?", title).groups()
            value, low, high = value if isinstance(value, tuple) else (value, "", "")
            self.rows.append([table, row, name, str(value), str(low), str(high), unit or ""])

    def run(self, tool, *words, codes=(0,), **more):
        """Runs a tool, or a program, in OUT and returns its output."""
        done = subprocess.run([str(word) for word in (tool, *words)], capture_output=True, text=True,
                              **{"cwd": self.out, **more})
        if done.returncode not in codes:
            sys.exit(f"{tool} {' '.join(map(str, words))} ended with {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        return done.stdout

    def make(self, folder, *words, keep_going=False):
        """make in a folder with these tools; with `keep_going` also where runs broke a limit of their health."""
        said = subprocess.run(["make", "-s", *(["-k"] if keep_going else []), "-C", str(folder), f"BIN={self.bin}/", *map(str, words)],
                              capture_output=True, text=True, check=False)
        if said.returncode and not keep_going:
            sys.exit(f"make in {folder} failed:\n{said.stderr[-2000:]}")

    def need_data(self, *names):
        for name in names:
            if not (self.data / name).exists():
                skip(f"{self.data / name} is not there")

    def command(self):
        own = [f"--{key.replace('_', '-')} {shlex.quote(str(value))}" for key, value in vars(self.options).items()
               if key not in self.shared and value != self.words.get_default(key)]
        return " ".join([f"python3 tests/studies/{self.name}.py", *own])

    def empty_unless_of(self):
        """Results of another commit in OUT are taken out."""
        mark = self.out / "commit"
        if self.out.exists() and any(self.out.iterdir()):
            if not mark.exists():
                sys.exit(f"{self.out} holds files that are not of a study, expected an empty folder")
            if mark.read_text() == self.commit and is_clean(self.commit):
                return
            shutil.rmtree(self.out)
        self.out.mkdir(parents=True, exist_ok=True)
        mark.write_text(self.commit)

    def main(self):
        self.options = self.words.parse_args()
        if self.options.list:
            for name, cost_s, _ in self.parts:
                print(f"{cost_s:6d} s  {name}")
            return
        self.bin, self.out, self.data = (path.resolve() for path in (self.options.bin, self.options.out, self.options.data))
        os.environ["PATH"] = f"{self.bin}:{os.environ['PATH']}"
        self.commit = commit_of(self.bin)
        head = {"command": self.command(), "commit": self.commit}
        self.empty_unless_of()
        all_rows, used_s, dates, missing = [], 0.0, [], []
        for name, _, compute in self.parts:
            kept = self.out / "parts" / f"{name}.csv"
            of_now = kept.exists() and head.items() <= read(kept)[0].items()
            if not of_now and (not self.options.only or name in self.options.only):
                self.rows, before = [], cpu_s()
                compute(self)
                write(kept, head | {"date": datetime.date.today().isoformat(), "machine": machine(),
                                    "cpu_s": f"{cpu_s() - before:.1f}"}, self.rows)
                of_now = True
            if not of_now:
                missing.append(name)
                continue
            said, rows = read(kept)
            all_rows += rows
            used_s += float(said["cpu_s"])
            dates.append(said["date"])
        if missing:
            return print(f"{self.name}: still to do: {', '.join(missing)}")
        write(self.out / f"{self.name}.csv", head | {"date": max(dates), "machine": machine(), "cpu_s": f"{used_s:.0f}"},
              [[row[column] for column in COLUMNS] for row in all_rows])
        for table in dict.fromkeys(row["table"] for row in all_rows):
            print("\n" + as_table([row for row in all_rows if row["table"] == table], table))
