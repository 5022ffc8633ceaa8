#!/usr/bin/env python3
"""Checks the rules of inclusion.

- Modules of libcore include one way, in their fixed order; verify and tools stand above all of them.
- Rooms of libcore (a .cpp and its .hpp are one) include each other in no circle.
- A header that other modules include says so in its first line: `// libcore/step/step.hpp: public`.
  All others are private to their module. Tests and benchmarks may include any.
- A tool includes its own folder, tools/frame and libcore; tools/frame includes no tool.
- The headers of a library stay in the sources that carry its name; tools use none.
- A plain file includes no header of a source that needs a library, so that plain targets link alone.
- A source of libcore without a header of its own says in its first line what it is.
"""
import graphlib
import pathlib
import re
import sys

MODULES = ["base", "sampling", "geometry", "motion", "terrain", "blocks", "site", "contact", "solver", "scene", "step",
           "paper", "draw", "io", "import", "record", "setup", "store", "ensemble", "run", "post", "report", "verify"]
LIBRARY_HEADERS = {
    "boost": re.compile(r"^boost/"),
    "cairo": re.compile(r"^(cairo|pango)"),
    "cgal": re.compile(r"^(CGAL|boost)/"),
    "gdal": re.compile(r"^(gdal|ogr|cpl_|proj)"),
    "hdf5": re.compile(r"^(hdf5|H5)"),
    "json": re.compile(r"^nlohmann/"),
    "sqlite": re.compile(r"^(SQLiteCpp/|sqlite3)"),
    "toml": re.compile(r"^toml\+\+/"),
}
FOREIGN = re.compile(r"^(CLI/|gtest/|rapidcheck)")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def library_of(path):
    """Name of the library that a file of libcore needs, by its suffix; empty for a plain one."""
    _, _, word = path.stem.rpartition("_")
    return word if word in LIBRARY_HEADERS and path.stem != word else ""


def sources_of(root, *folders):
    return [path for folder in folders for path in sorted((root / folder).rglob("*.[ch]pp"))]


def own_includes(path):
    return [header for bracket, header in INCLUDE.findall(path.read_text()) if bracket == '"']


def module_of(root, path):
    """libcore/step/lone/flight.hpp -> step; verify/cases/cases.hpp -> verify; tools/dda/x.hpp -> tools/dda."""
    parts = path.relative_to(root).parts
    return {"libcore": parts[1], "verify": "verify"}.get(parts[0], "/".join(parts[:2]))


def circles_of(root):
    """A circle of rooms of libcore, as one sentence; none where every room can be built on those below."""
    rooms = {}
    for path in sources_of(root, "libcore"):
        room = str(path.relative_to(root / "libcore").with_suffix(""))
        included = {header.rsplit(".", 1)[0] for header in own_includes(path)}
        rooms.setdefault(room, set()).update(included - {room})
    try:
        graphlib.TopologicalSorter(rooms).prepare()
    except graphlib.CycleError as error:
        yield " includes ".join(reversed(error.args[1])) + \
            ": rooms in a circle; move what they share into a room below them"


def marks_of(root):
    """Headers whose first line does not say what they are: their path, and whether others use them."""
    used_by = {}
    for path in sources_of(root, "libcore", "verify", "tools"):
        for header in own_includes(path):
            used_by.setdefault(header, set()).add(module_of(root, path))
    for path in sources_of(root, "libcore"):
        if path.suffix != ".hpp":
            continue
        name = str(path.relative_to(root))
        users = used_by.get(name.removeprefix("libcore/"), set()) - {module_of(root, path)}
        wanted = f"// {name}" + (": public" if users else "")
        found = path.read_text().split("\n", 1)[0]
        if found != wanted:
            why = f"included by {sorted(users)[0]}" if users else "included by its own module alone"
            yield f"{name} begins with '{found}', not with '{wanted}': it is {why}"


def first_lines_of(root):
    for path in sources_of(root, "libcore", "verify"):
        if path.suffix == ".cpp" and not path.with_suffix(".hpp").exists() and \
                not path.read_text().startswith("// "):
            yield f"{path.relative_to(root)} has no header of its own: say in its first line what it is"


def tools_of(root):
    for path in sources_of(root, "tools"):
        folder = module_of(root, path)
        for bracket, header in INCLUDE.findall(path.read_text()):
            where = f"{path.relative_to(root)} includes {header}"
            if bracket == "<" and any(pattern.match(header) for pattern in LIBRARY_HEADERS.values()):
                yield f"{where}: tools use libraries through libcore only"
            if bracket == '"' and header.startswith("tools/") and \
                    "/".join(header.split("/")[:2]) not in (folder, "tools/frame"):
                yield f"{where}: a tool includes its own folder and tools/frame; move what two share there"


def problems_of(root):
    yield from circles_of(root)
    yield from marks_of(root)
    yield from first_lines_of(root)
    yield from tools_of(root)
    for path in sources_of(root, "libcore", "verify"):
        module = module_of(root, path)
        suffix = library_of(path)
        for bracket, header in INCLUDE.findall(path.read_text()):
            where = f"{path.relative_to(root)} includes {header}"
            if bracket == '"':
                target = header.split("/")[0]
                if target not in MODULES:
                    yield f"{where}: own headers are named from libcore, MODULE/NAME.hpp"
                elif MODULES.index(target) > MODULES.index(module):
                    yield f"{where}: {module} stands above {target}, includes go upwards only"
                elif not (root / "libcore" / header).exists() and not (root / header).exists():
                    yield f"{where}: no such header"
                elif suffix == "" and module != "verify" and library_of(pathlib.Path(header)):
                    yield f"{where}: a plain file may not include what needs a library"
                continue
            if FOREIGN.match(header):
                yield f"{where}: belongs to tools or tests"
            may = [library for library, pattern in LIBRARY_HEADERS.items() if pattern.match(header)]
            if may and (suffix not in may or path.suffix != ".cpp"):
                yield f"{where}: only sources named *_{may[0]}.cpp may"


def main():
    root = pathlib.Path(sys.argv[1])
    problems = list(problems_of(root))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
