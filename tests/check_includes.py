#!/usr/bin/env python3
"""Checks the rules of inclusion: modules of libcore include one way, in their fixed order, and the
headers of a library stay in the sources that carry its name."""
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


def problems_of(root):
    for path in sorted((root / "libcore").rglob("*.[ch]pp")):
        module = path.relative_to(root / "libcore").parts[0]
        suffix = path.stem.rsplit("_", 1)[-1] if path.suffix == ".cpp" else ""
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
                continue
            if FOREIGN.match(header):
                yield f"{where}: belongs to tools or tests"
            for library, pattern in LIBRARY_HEADERS.items():
                if pattern.match(header) and suffix != library:
                    yield f"{where}: only sources named *_{library}.cpp may"


def main():
    root = pathlib.Path(sys.argv[1])
    problems = list(problems_of(root))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
