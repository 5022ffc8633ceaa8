#!/usr/bin/env python3
"""Checks the pages: every relative link of a *.md leads to a file or folder, and its #anchor to a
heading there; every page that sources, scripts and tests name as docs/... exists, and so does its
heading; every page under docs/ is reached from docs/index.md; no page or source holds the marks of an
unfinished merge."""
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)\s]+)\)")
NAMED = re.compile(r"\bdocs/(?:[\w-]+/)*[\w-]+\.md(?:#[\w-]+)?")
HEADING = re.compile(r"^#+ +(.*)$", re.MULTILINE)
MERGE_MARK = re.compile(r"^(?:<{7}|>{7}) ", re.MULTILINE)
FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
KINDS = {".cpp", ".hpp", ".in", ".py", ".sh", ".mk", ".smk", ".js", ".toml", ".txt", ".cmake", ".md"}


def anchors_of(path):
    """What GitHub makes of headings: lower case, blanks to hyphens, no other signs."""
    text = FENCED.sub("", path.read_text())
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in HEADING.findall(text)}


def problem_of(target, anchor):
    if not target.exists():
        return "no such file or folder"
    if anchor and anchor not in anchors_of(target):
        return f"no heading there for #{anchor}"
    return None


def files_of(root):
    """Sources and pages, without what builds and runs leave behind."""
    tops = [path for path in root.iterdir() if path.name not in ("build", ".git")]
    for path in sorted(file for top in tops for file in ([top] if top.is_file() else top.rglob("*"))):
        if path.suffix in KINDS and path.is_file() and "out" not in path.relative_to(root).parts:
            yield path


def problems_of(root):
    linked = {}
    for path in files_of(root):
        name, text = path.relative_to(root), path.read_text()
        if mark := MERGE_MARK.search(text):
            yield f"{name}:{text.count(chr(10), 0, mark.start()) + 1}: an unfinished merge"
        if path.suffix == ".md":
            for link in LINK.findall(text):
                if re.match(r"[a-z]+:", link):
                    continue
                where, _, anchor = link.partition("#")
                target = (path.parent / where).resolve() if where else path
                linked.setdefault(path, set()).add(target)
                if found := problem_of(target, anchor):
                    yield f"{name} links to {link}: {found}"
        for place in NAMED.findall(text):
            where, _, anchor = place.partition("#")
            if "NAME" not in where and (found := problem_of(root / where, anchor)):
                yield f"{name} names {place}: {found}"
    reached, todo = set(), [root / "docs/index.md"]
    while todo:
        page = todo.pop()
        if page not in reached:
            reached.add(page)
            todo += linked.get(page, ())
    for page in sorted((root / "docs").rglob("*.md")):
        if page not in reached:
            yield f"{page.relative_to(root)}: no way there from docs/index.md"


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1]).resolve()))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
