#!/usr/bin/env python3
"""Checks the rules of inclusion: modules of libcore include one way, in their fixed order; rooms of a
module (a .cpp and its .hpp are one) include each other in no circle; the headers of a library stay in
the sources that carry its name, also in tools; and a plain file includes no header of a source that
needs a library, so that plain targets link alone."""
import graphlib
import pathlib
import re
import sys

MODULES = ["base", "geometry", "terrain", "blocks", "scene", "contact", "dda", "io", "store", "post",
           "report", "verify"]
LIBRARY_HEADERS = {
    "cgal": re.compile(r"^(CGAL|boost)/"),
    "gdal": re.compile(r"^(gdal|ogr|cpl_|proj)"),
    "hdf5": re.compile(r"^(hdf5|H5)"),
    "sqlite": re.compile(r"^(SQLiteCpp/|sqlite3)"),
    "toml": re.compile(r"^toml\+\+/"),
}
FOREIGN = re.compile(r"^(CLI/|nlohmann/|gtest/|rapidcheck)")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def library_of(path):
    """Name of the library that a file of libcore needs, by its suffix; empty for a plain one."""
    word = path.stem.rsplit("_", 1)[-1]
    return word if word in LIBRARY_HEADERS else ""


def circles_of(root):
    """A circle of rooms of libcore, as one sentence; none where every room can be built on those below."""
    rooms = {}
    for path in sorted((root / "libcore").rglob("*.[ch]pp")):
        room = str(path.relative_to(root / "libcore").with_suffix(""))
        included = {header.rsplit(".", 1)[0] for bracket, header in INCLUDE.findall(path.read_text())
                    if bracket == '"'}
        rooms.setdefault(room, set()).update(included - {room})
    try:
        graphlib.TopologicalSorter(rooms).prepare()
    except graphlib.CycleError as error:
        yield " includes ".join(reversed(error.args[1])) + \
            ": rooms in a circle; move what they share into a room below them"


def problems_of(root):
    yield from circles_of(root)
    for path in sorted((root / "libcore").rglob("*.[ch]pp")):
        module = path.relative_to(root / "libcore").parts[0]
        suffix = library_of(path)
        for bracket, header in INCLUDE.findall(path.read_text()):
            where = f"{path.relative_to(root)} includes {header}"
            if bracket == '"':
                target = header.split("/")[0]
                if target not in MODULES:
                    yield f"{where}: own headers are named from libcore, MODULE/NAME.hpp"
                elif MODULES.index(target) > MODULES.index(module):
                    yield f"{where}: {module} stands above {target}, includes go upwards only"
                elif not (root / "libcore" / header).exists():
                    yield f"{where}: no such header"
                elif suffix == "" and library_of(pathlib.Path(header)):
                    yield f"{where}: a plain file may not include what needs a library"
                continue
            if FOREIGN.match(header):
                yield f"{where}: belongs to tools or tests"
            for library, pattern in LIBRARY_HEADERS.items():
                if pattern.match(header) and (suffix != library or path.suffix != ".cpp"):
                    yield f"{where}: only sources named *_{library}.cpp may"
    for path in sorted((root / "tools").glob("*.[ch]pp")):
        for bracket, header in INCLUDE.findall(path.read_text()):
            if bracket == "<" and any(pattern.match(header) for pattern in LIBRARY_HEADERS.values()):
                yield f"{path.relative_to(root)} includes {header}: tools use libraries through libcore only"


def main():
    root = pathlib.Path(sys.argv[1])
    problems = list(problems_of(root))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
