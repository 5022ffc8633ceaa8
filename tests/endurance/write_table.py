#!/usr/bin/env python3
"""write_table.py ROWS MARKDOWN: puts the rows of endurance.py, with the commit of the tools, in place of
what stands between the two marks of a Markdown file. Rows of faults that were not tried now stay."""
import datetime
import re
import sys
from pathlib import Path

BEGIN, END = "<!-- endurance -->", "<!-- /endurance -->"
HEAD = "| Fault | Tried | Survived | Lost | Commit | Date | |\n|---|---|---|---|---|---|---|\n"


def main(rows, markdown):
    text = Path(markdown).read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    old, after = rest.split(END)
    table = {re.split(r" *\| *", line)[1]: line for line in old.splitlines()
             if line.startswith("|") and not line.startswith(("| Fault", "|---"))}
    day = datetime.date.today().isoformat()
    for line in Path(rows).read_text(encoding="utf-8").splitlines():
        fault, tried, survived, lost, note, commit = line.split("\t")
        table[fault] = f"| {fault} | {tried} | {survived} | {lost} | {commit} | {day} | {note} |"
    body = BEGIN + "\n" + HEAD + "".join(line + "\n" for line in table.values()) + END
    Path(markdown).write_text(before + body + after, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
