#!/usr/bin/env python3
"""Checks that the page of talus-report, its template (tools/report/page.html) and its words fit.

- Each key that template, scripts or code name is in texts.toml, and each key of it is named.
- Each part that the template takes in is there.
- No words stand in the template, nor two in a row in the code of the page.
"""
import pathlib
import re
import sys
import tomllib

ROOMS = ["tools/report", "libcore/report"]
# Not of the page: its data and what is wrong with them, the QGIS project, the look before the runs.
NOT_THE_PAGE = {"talus_report.cpp", "folder.cpp", "project.cpp", "qgis_project.cpp", "qgis_template_gdal.cpp",
                "check_view_cairo.cpp", "texts.cpp", "texts_toml.cpp", "map_cells_gdal.cpp", "styles_gdal.cpp",
                "page_template_json.cpp",
                # titles of fields: section [said] of a translation
                "run_health.cpp", "viewer_scene.cpp"}
FILE_ENDINGS = {"csv", "gpkg", "html", "json", "js", "pdf", "png", "qgz", "qml", "svg", "tif", "toml", "css"}
ALLOWED = {"contour five", "object line", "fence line"}  # classes of the style sheet
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
WORDS = re.compile(r"(?<![\w.#-])[A-Za-z]{2,}(?: [a-z]{2,})+")


def texts_of(table, of=""):
    """Of each key "section.key" its texts."""
    for name, node in table.items():
        if isinstance(node, dict):
            yield from texts_of(node, of + name + ".")
        else:
            yield of + name, [node] if isinstance(node, str) else node


def keys_in(source, sections):
    """Literals "section.key" of C++, {{section.key}} of a script."""
    for literal in LITERAL.findall(source) + re.findall(r"\{\{([\w.]+)\}\}", source):
        section, _, key = literal.partition(".")
        if section in sections and re.fullmatch(r"\w+", key) and key not in FILE_ENDINGS:
            yield literal


def main():
    root = pathlib.Path(sys.argv[1])
    file, page = root / "tools/report/texts.toml", root / "tools/report/page.html"
    table = tomllib.loads(file.read_text())
    texts = dict(texts_of(table))
    faults, used = [], {"page.sections"}

    def use(key, where):
        used.add(key)
        if key not in texts:
            faults.append(f"{where}: {key} is not in {file.name}")

    template = page.read_text().partition("{{@page}}")[2]
    for mark in re.findall(r"\{\{[=*]([^} ]+)", template):
        if "@" in mark:  # by a value: all of its section that the code names
            section = mark.partition(".")[0]
            used.update(key for key in texts if key.startswith(section + ".") and section in ("passage", "nav", "spread"))
        else:
            use(mark, page.name)
    parts = set(re.findall(r"^\{\{@(\w+)\}\}$", template, re.M)) | {"page"}
    for part in re.findall(r"\{\{\+(\w+)", template) + texts["page.sections"]:
        if part not in parts:
            faults.append(f"{page.name}: there is no part {part}")
    for section in texts["page.sections"]:
        use("nav." + section, file.name)
        use(section + ".title", file.name)
    words = re.sub(r"<style>.*?</style>|<script.*?</script>|<[^>]*>|\{\{.*?\}\}|&\w+;", "\n", template, flags=re.S)
    for word in re.findall(r"[A-Za-z]{4,}", words):
        faults.append(f"{page.name}: {word} belongs into {file.name}")

    for path in [path for room in ROOMS for path in sorted((root / room).glob("*"))]:
        if path.suffix not in {".cpp", ".js"}:
            continue
        code = re.sub(r"(?m)(^|\s)//.*$", "", path.read_text())
        where = path.relative_to(root)
        for key in keys_in(code, table):
            use(key, where)
        if path.suffix == ".cpp" and path.name not in NOT_THE_PAGE:
            for section in ("fences", "result"):  # short names of rows
                used.update(f"{section}.{name}" for name in LITERAL.findall(code) if f"{section}.{name}" in texts)
            for literal in LITERAL.findall(code):
                if literal not in ALLOWED and "changed." not in literal and WORDS.search(re.sub(r"<[^>]*>?|&\w+;", "", literal)):
                    faults.append(f"{where}: \"{literal}\" belongs into {file.name}")
    used.update([f"{key}_rocks" for key in used if f"{key}_rocks" in texts])  # Texts::speak_of_rocks()
    faults += [f"{file.relative_to(root)}: {key} is used by no code" for key in sorted(set(texts) - used)]
    print("\n".join(faults) if faults else f"{len(texts)} texts, each used; no other is")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
